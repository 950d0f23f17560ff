// Where the value of a parameter comes from, and which of several wins.
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/base/nearest_name.h"
#include "core/element/file_notes.h"
#include "core/module/group_parameter.h"
#include "core/plugin/module_type_name.h"
#include "plugins/application_files/build_context.h"
#include "plugins/application_tags/tag_list.h"
#include "plugins/parameters/configuration.h"
#include "plugins/parameters/configuration_saver.h"
#include "plugins/parameters/file_path.h"

namespace runnel::internal {

namespace {

namespace fs = std::filesystem;

constexpr const char* kCommandLine = "command line";  // as Configuration calls it
constexpr auto kNameOfDeclared = &std::pair<const std::string, TagUse>::first;

// What is wrong with the name that the tag says.
void CheckName(const TagUse& use, const FrameworkElement& module, const ConfigurableElement& found) {
  const XmlAttribute& name = use.Get("name");
  if (found) {
    if (found.element->name() == name.value) return;
    return use.context.Warn({.message = "'" + name.value + "' is called '" + found.element->name() + "' now"},
                            name.value_position, module);
  }
  const auto names = NamesOf(ConfigurablesOf(module), [](const auto& each) { return each.element->name(); });
  if (!use.context.IsNews(module, name.value, names)) return;
  use.context.Report(
      {.message = "there is no parameter '" + name.value + "'", .hint = NearestNameHint(name.value, names)},
      name.value_position, module);
}

// A text that wants to become the value, and where relative file names in it start.
struct Candidate {
  std::string text;
  SourcePosition position;
  fs::path folder;
};

void WarnOfUnknownEntry(const XmlAttribute& path, const TagUse& use) {
  const std::vector<std::string> known = use.context.configuration().EntryPaths();
  const std::string nearest = NearestName(path.value, known);
  if (nearest.empty()) return;  // files for several applications need not have everything
  use.context.Warn(
      {.message = "the configuration has no '" + path.value + "'", .hint = "did you mean '" + nearest + "'?"},
      path.value_position, use.parent);
}

std::vector<Candidate> Candidates(const TagUse& use, const FrameworkElement& scope);

// What the <group_type> round `scope` says of its parameter, and what the group says that uses it.
std::vector<Candidate> CandidatesOfPart(const XmlAttribute& from, const TagUse& use, const FrameworkElement& scope) {
  PartUse* const part = use.context.parts().FindAround(&scope);
  if (part == nullptr) {
    use.context.Report(
        {.message = "there is no <group_type> here whose parameters could be used", .hint = "write value=\"…\""},
        from.position, use.parent);
    return {};
  }
  const auto declared = part->declared.find(from.value);
  if (declared == part->declared.end()) {
    use.context.Report({.message = "<group_type> has no parameter '" + from.value + "'",
                        .hint = NearestNameHint(from.value, NamesOf(part->declared, kNameOfDeclared))},
                       from.value_position, use.parent);
    return {};
  }
  part->used.insert(from.value);
  std::vector<Candidate> candidates = Candidates(declared->second, part->group);
  if (const auto given = part->given.find(from.value); given != part->given.end()) {
    const std::vector<Candidate> stronger = Candidates(given->second, *part->group.parent());
    candidates.insert(candidates.end(), stronger.begin(), stronger.end());
  }
  return candidates;
}

// From the weakest to the strongest. `scope`: what `from` is looked up from, upwards.
std::vector<Candidate> Candidates(const TagUse& use, const FrameworkElement& scope) {
  BuildContext& context = use.context;
  std::vector<Candidate> candidates;
  if (const XmlAttribute* value = use.Find("value")) {
    candidates.push_back({value->value, value->value_position, context.FolderOf(value->position)});
  }
  // Of one that a <group_type> declares that is wrong: it might name itself, without an end.
  const bool is_declared = use.xml.parent()->name() == "group_type";
  if (const XmlAttribute* from = use.Find("from"); from != nullptr && !is_declared) {
    candidates = CandidatesOfPart(*from, use, scope);
  }
  if (const XmlAttribute* path = use.Find("config")) {
    const Configuration::Entry* const entry = context.configuration().FindEntry(path->value);
    if (entry != nullptr) {
      candidates.push_back({entry->text, entry->position, fs::path(entry->position.file).parent_path()});
    } else {
      WarnOfUnknownEntry(*path, use);
    }
  }
  if (const XmlAttribute* name = use.Find("command_line")) {
    const Configuration::Entry* const entry = context.configuration().FindArgument(name->value);
    // Where the shell that completes file names is, too.
    if (entry != nullptr) candidates.push_back({entry->text, entry->position, fs::path()});
  }
  return candidates;
}

// The entry of the configuration by which the value can be set, the strongest that is named; nullptr if none is.
const XmlAttribute* EntryAttribute(const TagUse& use, const FrameworkElement& scope) {
  if (const XmlAttribute* own = use.Find("config")) return own;
  const XmlAttribute* const from = use.Find("from");
  PartUse* const part = from != nullptr ? use.context.parts().FindAround(&scope) : nullptr;
  if (part == nullptr) return nullptr;
  const auto given = part->given.find(from->value);
  if (given != part->given.end()) {
    if (const auto* entry = EntryAttribute(given->second, *part->group.parent())) return entry;
  }
  const auto declared = part->declared.find(from->value);
  return declared != part->declared.end() ? declared->second.Find("config") : nullptr;
}

// The parameter of the group whose inside another file describes, made when a first value comes from it.
GroupParameter* ParameterOf(PartUse& part, const std::string& name, const TagUse& use) {
  if (FrameworkElement* const known = part.group.FindChild(name)) {
    return dynamic_cast<GroupParameter*>(known);
  }
  const auto declared = part.declared.find(name);
  if (declared == part.declared.end()) return nullptr;
  auto& made = use.context.runtime().Create<GroupParameter>(part.group, name);
  made.Annotate(std::make_unique<SourcePlace>(declared->second.xml.position()));
  return &made;
}

// All groups by whose parameters the value has come can set it while the application runs.
void TieToGroups(const TagUse& first, const FrameworkElement& parameter, const FrameworkElement& first_scope) {
  const TagUse* use = &first;
  const FrameworkElement* scope = &first_scope;
  while (const XmlAttribute* from = use->Find("from")) {
    PartUse* const part = use->context.parts().FindAround(scope);
    GroupParameter* const group = part != nullptr ? ParameterOf(*part, from->value, *use) : nullptr;
    if (group == nullptr) return;
    group->Add(parameter.path().substr(part->group.path().size() + 1));
    const auto given = part->given.find(from->value);
    if (given == part->given.end()) return;
    use = &given->second;
    scope = part->group.parent();
  }
}

std::string Text(const Candidate& candidate, const Configurable& configurable) {
  if (&configurable.type() != &TypeOf<FilePath>()) return candidate.text;
  return ResolvedAgainst(candidate.folder, {candidate.text}).text;
}

}  // namespace

void SetValue(const TagUse& use, const FrameworkElement& module, const FrameworkElement& scope, bool may_wait) {
  const ConfigurableElement found = FindConfigurable(module, use.Get("name").value);
  Configurable* const configurable = found.configurable;
  // It, or what it stands for, may be made only when all other parameters are set.
  const auto* const group = dynamic_cast<const GroupParameter*>(configurable);
  if (may_wait && IsModule(module) && (!found || (group != nullptr && group->Find().empty()))) {
    return use.context.Defer(BuildStage::kConstruction,
                             [use, &module, &scope] { SetValue(use, module, scope, false); });
  }
  CheckName(use, module, found);
  const std::vector<Candidate> candidates = Candidates(use, scope);
  if (!found) return;
  FrameworkElement& element = *found.element;
  const std::string path = element.path();
  TieToGroups(use, element, scope);
  if (const XmlAttribute* const entry = EntryAttribute(use, scope)) {
    element.Annotate(std::make_unique<ConfigurationEntry>(entry->value));
  }
  if (!candidates.empty() && candidates.back().position.file == kCommandLine) {
    use.context.NoteCommandLine(element);
  }
  bool all_are_good = true;
  for (const Candidate& candidate : candidates) {
    const auto good = configurable->CheckText(Text(candidate, *configurable));
    if (good) continue;
    all_are_good = false;
    Error error = good.error();
    error.path = path;
    use.context.Report(std::move(error), candidate.position, use.parent);
  }
  // Ports may follow from it.
  if (!all_are_good && configurable->info().is_static) use.context.MarkUnbuilt(module);
  if (!all_are_good) return;
  if (candidates.empty()) return NoteLoaded(found);
  const Candidate& strongest = candidates.back();
  const auto set = configurable->SetFromText(Text(strongest, *configurable));
  if (!set) use.context.Report(set.error(), strongest.position, use.parent);
  NoteLoaded(found);
}

void NoteLoaded(const ConfigurableElement& parameter) {
  parameter.element->Annotate(std::make_unique<LoadedValue>(parameter.configurable->ToText()));
}

}  // namespace runnel::internal

// config="/car/left" of <application>, <group> and <module>: entries for all parameters within.
namespace runnel {

namespace {

// What its own tag has said of an entry, or a stronger source, stays.
void TakeEntry(FrameworkElement& element, Configurable& parameter, BuildContext& context) {
  if (element.FindAnnotation<ConfigurationEntry>() != nullptr) return;
  std::string path = EntryInSection(element, element.name());
  const Configuration::Entry* entry = context.configuration().FindEntry(path);
  const auto* const former = element.FindAnnotation<FormerName>();
  if (former != nullptr && entry == nullptr) {
    path = EntryInSection(element, former->name);
    entry = context.configuration().FindEntry(path);
  }
  if (path.empty() || entry == nullptr) return;
  element.Annotate(std::make_unique<ConfigurationEntry>(path));
  if (context.IsFromCommandLine(element)) return;
  std::string text = entry->text;
  if (&parameter.type() == &TypeOf<FilePath>()) {
    const std::filesystem::path folder = std::filesystem::path(entry->position.file).parent_path();
    text = ResolvedAgainst(folder, {text}).text;
  }
  if (const auto set = parameter.SetFromText(text); !set) {
    context.Report(set.error(), entry->position, element);
  }
  internal::NoteLoaded({&element, &parameter});
}

void TakeEntries(FrameworkElement& top, BuildContext& context) {
  top.Visit([&](FrameworkElement& each) {
    auto* const parameter = dynamic_cast<Configurable*>(&each);
    if (parameter == nullptr || ConfigurationSection::FindAround(each) != &top) return;
    TakeEntry(each, *parameter, context);
  });
}

}  // namespace

AddedAttribute ConfigurationAttribute(std::string tag) {
  return {.tag = std::move(tag),
          .rule = KindRule("config", AttributeKind::kPath,
                           "the section of the configuration that has values for the parameters within, by their "
                           "paths; one without a '/' in front lies in that of the group around"),
          .handle =
              [](const XmlAttribute& attribute, FrameworkElement& element, BuildContext& context) {
                std::string path = attribute.value;
                if (path.front() != '/') {
                  const FrameworkElement* const around =
                      element.parent() != nullptr ? ConfigurationSection::FindAround(*element.parent()) : nullptr;
                  path = (around != nullptr ? around->FindAnnotation<ConfigurationSection>()->path : "") + "/" + path;
                }
                while (path.ends_with('/')) path.pop_back();
                element.Annotate(std::make_unique<ConfigurationSection>(std::move(path), attribute.value));
                // Behind all that is said of single parameters; once more for those that modules make by others.
                context.Defer(BuildStage::kParameters, [&element, &context] {
                  context.Defer(BuildStage::kParameters, [&element, &context] {
                    TakeEntries(element, context);
                    context.Defer(BuildStage::kConstruction, [&element, &context] { TakeEntries(element, context); });
                  });
                });
              },
          .saved = [](FrameworkElement& element) -> std::string {
            const auto* const section = element.FindAnnotation<ConfigurationSection>();
            return section != nullptr ? section->said : "";
          }};
}

}  // namespace runnel

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/base/nearest_name.h"
#include "core/plugin/module_type_name.h"
#include "plugins/application_files/build_context.h"
#include "plugins/application_files/path_use.h"
#include "plugins/application_files/saving/file_update.h"
#include "plugins/application_files/tags/built_in_tags.h"
#include "plugins/parameters/file_path.h"

namespace runnel {

namespace {

namespace fs = std::filesystem;

constexpr auto kNameOfDeclared = &std::pair<const std::string, TagUse>::first;

Configurable* FindParameter(const TagUse& use, const FrameworkElement& module) {
  const XmlAttribute& name = use.Get("name");
  if (const auto found = FindConfigurable(module, name.value)) return found.configurable;
  const auto name_of = [](const auto& each) { return each.element->name(); };
  use.context.Report(
      {.message = "there is no parameter '" + name.value + "'",
       .hint = NearestNameHint(name.value, NamesOf(ConfigurablesOf(module), name_of))},
      name.value_position, module);
  return nullptr;
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
  use.context.Warn({.message = "the configuration has no '" + path.value + "'",
                    .hint = "did you mean '" + nearest + "'?"},
                   path.value_position, use.parent);
}

std::vector<Candidate> Candidates(const TagUse& use, const FrameworkElement& scope);

// What the <group_type> round `scope` says of its parameter, and what the group says that uses it.
std::vector<Candidate> CandidatesOfPart(const XmlAttribute& from, const TagUse& use,
                                        const FrameworkElement& scope) {
  PartUse* const part = use.context.parts().FindAround(&scope);
  if (part == nullptr) {
    use.context.Report({.message = "there is no <group_type> here whose parameters could be used",
                        .hint = "write value=\"…\""},
                       from.position, use.parent);
    return {};
  }
  const auto declared = part->declared.find(from.value);
  if (declared == part->declared.end()) {
    use.context.Report(
        {.message = "<group_type> has no parameter '" + from.value + "'",
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
      candidates.push_back(
          {entry->text, entry->position, fs::path(entry->position.file).parent_path()});
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

std::string Text(const Candidate& candidate, const Configurable& configurable) {
  if (&configurable.type() != &TypeOf<FilePath>()) return candidate.text;
  return ResolvedAgainst(candidate.folder, {candidate.text}).text;
}

// All candidates are looked at, so that a mistake in the file shows even when it is overridden.
void SetValue(const TagUse& use, const FrameworkElement& module, const FrameworkElement& scope) {
  Configurable* const configurable = FindParameter(use, module);
  const std::vector<Candidate> candidates = Candidates(use, scope);
  if (configurable == nullptr) return;
  const std::string path = dynamic_cast<FrameworkElement&>(*configurable).path();
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
  if (candidates.empty()) return use.context.NoteValue(path, configurable->ToText());
  const Candidate& strongest = candidates.back();
  const auto set = configurable->SetFromText(Text(strongest, *configurable));
  if (!set) use.context.Report(set.error(), strongest.position, use.parent);
  use.context.NoteValue(path, configurable->ToText());
}

bool HaveSame(std::string_view attribute, XmlElement one, XmlElement other) {
  const XmlAttribute* const first = one.Attribute(attribute);
  const XmlAttribute* const second = other.Attribute(attribute);
  if (first == nullptr || second == nullptr) return first == second;
  return first->value == second->value;
}

bool IsFirstOfItsName(const TagUse& use) {
  for (const XmlElement sibling : use.xml.parent()->children()) {
    if (sibling == use.xml) return true;
    const XmlAttribute* const name = sibling.Attribute("name");
    if (sibling.name() != use.xml.name() || name == nullptr) continue;
    if (name->value != use.Get("name").value || !HaveSame("of", sibling, use.xml)) continue;
    use.context.Report({.message = "the parameter '" + name->value + "' is set twice",
                        .hint = "the first is in line " + std::to_string(sibling.position().line)},
                       use.Get("name").value_position, use.parent);
    return false;
  }
  return true;
}

void CheckSources(const TagUse& use) {
  const bool sets_something =
      use.Find("value") || use.Find("config") || use.Find("command_line") || use.Find("from");
  if (!sets_something) {
    use.context.Report({.message = "<parameter> does not say where the value comes from",
                        .hint = "add value=\"…\", config=\"…\" or command_line=\"…\""},
                       use.xml.position(), use.parent);
  }
  const XmlAttribute* const from = use.Find("from");
  if (from != nullptr && use.Find("value")) {
    use.context.Report({.message = "a value and a parameter that it comes from",
                        .hint = "leave out one of value and from"},
                       from->position, use.parent);
  }
}

void RefuseAttribute(std::string_view name, std::string hint, const TagUse& use) {
  const XmlAttribute* const attribute = use.xml.Attribute(name);
  if (attribute == nullptr) return;
  use.context.Report(
      {.message = "'" + std::string(name) + "' has no meaning here", .hint = std::move(hint)},
      attribute->position, use.parent);
}

// In a <group_type>: without a value it has to be given where the file is used.
void Declare(const TagUse& use, PartUse& part) {
  RefuseAttribute("from", "leave it out: where the file is used, it may be said", use);
  RefuseAttribute("of", "leave it out", use);
  if (!IsFirstOfItsName(use)) return;
  part.declared.emplace(use.Get("name").value, use);
}

// In a group whose type is a file: of one of its parameters, or, with `of`, of a module in it.
void Give(const TagUse& use, PartUse& part) {
  CheckSources(use);
  if (!IsFirstOfItsName(use)) return;
  const XmlAttribute& name = use.Get("name");
  if (const XmlAttribute* of = use.Find("of")) {
    use.context.Defer(BuildStage::kParameters, [use, of] {
      const FrameworkElement* const module = SearchElement(PathIn(*of, use.parent), use.context);
      if (module == nullptr) return;
      if (module->IsAtOrBelow(use.parent)) {
        return SetValue(use, *module, *use.parent.parent());
      }
      // It may even be of another application, which a failed build could not give its value back.
      use.context.Report({.message = module->path() + " is not within this group",
                          .hint = "set its parameters where it stands itself"},
                         of->value_position, use.parent);
    });
    return;
  }
  if (part.declared.contains(name.value)) {
    part.given.emplace(name.value, use);
    return;
  }
  use.context.Report(
      {.message = part.root.position().file + " has no parameter '" + name.value + "'",
       .hint = NearestNameHint(name.value, NamesOf(part.declared, kNameOfDeclared))},
      name.value_position, use.parent);
}

FrameworkElement* HandleParameter(const TagUse& use) {
  if (PartUse* part = use.context.parts().Find(use.parent)) {
    use.xml.parent() == part->root ? Declare(use, *part) : Give(use, *part);
    return &use.parent;
  }
  if (use.parent.kind() == ElementKind::kGroup) {
    const bool has_type = use.xml.parent()->Attribute("type") != nullptr;
    if (has_type) return &use.parent;  // the file could not be read
    use.context.Report(
        {.message = "a group without a type has no parameters", .hint = "write it into a module"},
        use.xml.position(), use.parent);
    return &use.parent;
  }
  CheckSources(use);
  RefuseAttribute("of", "leave it out: the module round it is meant", use);
  if (IsFirstOfItsName(use)) {
    use.context.Defer(BuildStage::kParameters, [use] { SetValue(use, use.parent, use.parent); });
  }
  return &use.parent;
}

// Saving. What came from the command line or a configuration is theirs, as long as it is as it was loaded.

bool IsAsLoaded(const ConfigurableElement& parameter, const std::string* loaded) {
  const std::string text = parameter.configurable->ToText();
  return text == (loaded != nullptr ? *loaded : parameter.configurable->info().default_value);
}

void UpdateParameter(XmlElement tag, FrameworkElement& module, internal::FileUpdate& update) {
  if (!IsModule(module)) return;
  const ConfigurableElement parameter = FindConfigurable(module, internal::NameOf(tag));
  if (!parameter) return update.editor().Remove(tag);
  const std::string path = parameter.element->path();
  const std::string* const loaded = update.LoadedValue(path);
  update.saving().values[path] = parameter.configurable->ToText();
  if (loaded == nullptr || !IsAsLoaded(parameter, loaded)) {
    const std::string value = internal::SavedValue(*parameter.configurable, update.saving());
    update.saving().CheckText(value, *parameter.element);
    if (update.OverrideValue(*parameter.element, value)) return;
    return update.editor().SetAttribute(tag, "value", value);
  }
  const XmlAttribute* const value = tag.Attribute("value");
  const bool is_file = &parameter.configurable->type() == &TypeOf<FilePath>();
  if (value == nullptr || !is_file) return;
  const std::string moved = update.Moved(value->value);
  if (moved != value->value) update.editor().SetAttribute(tag, "value", moved);
}

bool HasTag(XmlElement module_tag, const std::string& name) {
  return std::ranges::any_of(module_tag.children(), [&](XmlElement child) {
    return child.name() == "parameter" && internal::NameOf(child) == name;
  });
}

std::vector<NewElement> MissingParameters(const XmlElement* tag, FrameworkElement& module,
                                          internal::Saving& saving, internal::FileUpdate* update) {
  std::vector<NewElement> missing;
  if (!IsModule(module)) return missing;
  for (const ConfigurableElement& each : ConfigurablesOf(module)) {
    if (tag != nullptr && HasTag(*tag, each.element->name())) continue;
    const std::string path = each.element->path();
    // It may have been set from outside of the part that the module is in.
    const std::string* const loaded = update != nullptr ? update->LoadedValue(path) : nullptr;
    const bool is_as_loaded = IsAsLoaded(each, loaded);
    if (loaded != nullptr || !is_as_loaded) saving.values[path] = each.configurable->ToText();
    if (is_as_loaded) continue;
    const std::string value = internal::SavedValue(*each.configurable, saving);
    saving.CheckText(value, *each.element);
    if (update != nullptr && update->OverrideValue(*each.element, value)) continue;
    missing.push_back(
        {.name = "parameter", .attributes = {{"name", each.element->name()}, {"value", value}}});
  }
  return missing;
}

}  // namespace

XmlTag ParameterTag() {
  return {.name = "parameter",
          .summary = "sets a parameter of its module or group",
          .parents = {"module", "group", "group_type"},
          .attributes = {{.name = "name", .kind = AttributeKind::kName, .required = true},
                         {.name = "of",
                          .kind = AttributeKind::kPath,
                          .summary = "in a group whose type is a file: the module in it"},
                         {.name = "from",
                          .kind = AttributeKind::kName,
                          .summary = "the parameter of the <group_type> whose value it takes"},
                         {.name = "value",
                          .summary = "in text format; a number may have another unit of the same "
                                     "kind, as in 15 cm"},
                         {.name = "config",
                          .kind = AttributeKind::kPath,
                          .summary = "the entry of the configuration file that beats the value"},
                         {.name = "command_line",
                          .kind = AttributeKind::kName,
                          .summary = "the name on the command line that beats both"}},
          .handle = HandleParameter,
          .update = UpdateParameter,
          .missing = MissingParameters};
}

}  // namespace runnel

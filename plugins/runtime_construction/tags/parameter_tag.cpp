#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/nearest_name.h"
#include "plugins/parameters/file_path.h"
#include "plugins/runtime_construction/build_context.h"
#include "plugins/runtime_construction/configurable_search.h"
#include "plugins/runtime_construction/tags/built_in_tags.h"

namespace runnel {

namespace {

namespace fs = std::filesystem;

Configurable* FindConfigurable(const TagUse& use) {
  const XmlAttribute& name = use.Get("name");
  std::vector<std::string> names;
  for (const ConfigurableElement& each : ConfigurablesOf(use.parent)) {
    if (each.element->name() == name.value) return each.configurable;
    names.push_back(each.element->name());
  }
  use.context.Report({.message = "there is no parameter '" + name.value + "'",
                      .hint = NearestNameHint(name.value, names)},
                     name.value_position, use.parent);
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

// From the weakest to the strongest.
std::vector<Candidate> Candidates(const TagUse& use) {
  BuildContext& context = use.context;
  std::vector<Candidate> candidates;
  if (const XmlAttribute* value = use.Find("value")) {
    candidates.push_back({value->value, value->value_position, context.folder()});
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
void SetParameter(const TagUse& use) {
  Configurable* const configurable = FindConfigurable(use);
  const std::vector<Candidate> candidates = Candidates(use);
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
  if (!all_are_good) return;
  if (candidates.empty()) return use.context.NoteValue(path, configurable->ToText());
  const Candidate& strongest = candidates.back();
  const auto set = configurable->SetFromText(Text(strongest, *configurable));
  if (!set) use.context.Report(set.error(), strongest.position, use.parent);
  use.context.NoteValue(path, configurable->ToText());
}

bool IsFirstOfItsName(const TagUse& use) {
  for (const XmlElement sibling : use.xml.parent()->children()) {
    if (sibling == use.xml) return true;
    const XmlAttribute* const name = sibling.Attribute("name");
    if (sibling.name() != use.xml.name() || name == nullptr) continue;
    if (name->value != use.Get("name").value) continue;
    use.context.Report({.message = "the parameter '" + name->value + "' is set twice",
                        .hint = "the first is in line " + std::to_string(sibling.position().line)},
                       use.Get("name").value_position, use.parent);
    return false;
  }
  return true;
}

FrameworkElement* HandleParameter(const TagUse& use) {
  const bool sets_something = use.Says("value") || use.Says("config") || use.Says("command_line");
  if (!sets_something) {
    use.context.Report({.message = "<parameter> does not say where the value comes from",
                        .hint = "add value=\"…\", config=\"…\" or command_line=\"…\""},
                       use.xml.position(), use.parent);
  }
  if (IsFirstOfItsName(use)) {
    use.context.Defer(BuildStage::kParameters, [use] { SetParameter(use); });
  }
  return &use.parent;
}

}  // namespace

XmlTag ParameterTag() {
  return {.name = "parameter",
          .summary = "sets a parameter of its module",
          .parents = {"module"},
          .attributes = {{.name = "name", .kind = AttributeKind::kName, .required = true},
                         {.name = "value", .summary = "in text form, without unit"},
                         {.name = "config",
                          .kind = AttributeKind::kPath,
                          .summary = "the entry of the configuration file that beats the value"},
                         {.name = "command_line",
                          .kind = AttributeKind::kName,
                          .summary = "the name on the command line that beats both"}},
          .handle = HandleParameter};
}

}  // namespace runnel

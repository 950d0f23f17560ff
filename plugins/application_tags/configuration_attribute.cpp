// config="/car/left" of <application>, <group> and <module>: entries for all parameters within.

#include <filesystem>
#include <utility>

#include "core/element/former_name.h"
#include "core/module/group_parameter.h"
#include "core/paths/path_search.h"
#include "plugins/application_files/build_context.h"
#include "plugins/application_tags/tag_list.h"
#include "plugins/parameters/configuration.h"
#include "plugins/parameters/file_path.h"

namespace runnel {

namespace {

const FrameworkElement* NearestSection(const FrameworkElement& element) {
  const FrameworkElement* at = &element;
  while (at != nullptr && at->FindAnnotation<ConfigurationSection>() == nullptr) at = at->parent();
  return at;
}

// "/car/left/motor/radius" of /robot/left/motor/parameter/radius, if /robot/left has the section /car/left.
std::string EntryOf(const FrameworkElement& parameter, const std::string& name, const FrameworkElement& section) {
  std::string path = "/" + name;
  for (const FrameworkElement* at = parameter.parent(); at != &section; at = at->parent()) {
    if (at->kind() != ElementKind::kPortGroup) path = "/" + at->name() + path;
  }
  return section.FindAnnotation<ConfigurationSection>()->path + path;
}

// What its own tag has said of an entry, or a stronger source, stays.
void TakeEntry(FrameworkElement& element, Configurable& parameter, const FrameworkElement& section,
               BuildContext& context) {
  if (element.FindAnnotation<ConfigurationEntry>() != nullptr) return;
  std::string path = EntryOf(element, element.name(), section);
  const auto* const former = element.FindAnnotation<FormerName>();
  if (former != nullptr && context.configuration().FindEntry(path) == nullptr) {
    const std::string old_path = EntryOf(element, former->name, section);
    if (context.configuration().FindEntry(old_path) != nullptr) path = old_path;
  }
  element.Annotate(std::make_unique<ConfigurationEntry>(path));
  if (context.IsFromCommandLine(element)) return;
  const Configuration::Entry* const entry = context.configuration().FindEntry(path);
  if (entry == nullptr) return;
  std::string text = entry->text;
  if (&parameter.type() == &TypeOf<FilePath>()) {
    const std::filesystem::path folder = std::filesystem::path(entry->position.file).parent_path();
    text = ResolvedAgainst(folder, {text}).text;
  }
  if (const auto set = parameter.SetFromText(text); !set) {
    context.Report(set.error(), entry->position, element);
  }
  context.NoteValue(element.path(), parameter.ToText());
}

void TakeEntries(FrameworkElement& top, BuildContext& context) {
  top.Visit([&](FrameworkElement& each) {
    auto* const parameter = dynamic_cast<Configurable*>(&each);
    const bool has_own_value = dynamic_cast<GroupParameter*>(&each) == nullptr;
    if (parameter == nullptr || !has_own_value || NearestSection(each) != &top) return;
    TakeEntry(each, *parameter, top, context);
  });
}

}  // namespace

AddedAttribute ConfigurationAttribute(std::string tag) {
  return {
      .tag = std::move(tag),
      .rule = {.name = "config",
               .kind = AttributeKind::kPath,
               .summary =
                   "the section of the configuration that has values for the parameters within, by "
                   "their paths; one without a '/' in front lies in that of the group around"},
      .handle =
          [](const XmlAttribute& attribute, FrameworkElement& element, BuildContext& context) {
            std::string path = attribute.value;
            if (path.front() != '/') {
              const FrameworkElement* const around =
                  element.parent() != nullptr ? NearestSection(*element.parent()) : nullptr;
              path =
                  (around != nullptr ? around->FindAnnotation<ConfigurationSection>()->path : "") +
                  "/" + path;
            }
            while (path.ends_with('/')) path.pop_back();
            element.Annotate(
                std::make_unique<ConfigurationSection>(std::move(path), attribute.value));
            // Behind all that is said of single parameters.
            context.Defer(BuildStage::kParameters, [&element, &context] {
              context.Defer(BuildStage::kParameters,
                            [&element, &context] { TakeEntries(element, context); });
            });
          },
      .saved = [](FrameworkElement& element) -> std::string {
        const auto* const section = element.FindAnnotation<ConfigurationSection>();
        return section != nullptr ? section->said : "";
      }};
}

}  // namespace runnel

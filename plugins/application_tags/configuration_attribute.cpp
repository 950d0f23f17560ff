// config="/car/left" of <application>, <group> and <module>: entries for all parameters within.

#include <filesystem>
#include <utility>

#include "core/element/file_notes.h"
#include "plugins/application_files/build_context.h"
#include "plugins/application_tags/tag_list.h"
#include "plugins/parameters/configuration.h"
#include "plugins/parameters/file_path.h"

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

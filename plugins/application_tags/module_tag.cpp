#include "core/plugin/module_type_name.h"
#include "plugins/application_files/build_context.h"
#include "plugins/application_files/saving/saving.h"
#include "plugins/application_tags/tag_list.h"
#include "plugins/parameters/value_to_save.h"

namespace runnel {

namespace {

FrameworkElement* MakeModule(const TagUse& use) {
  if (!use.HasFreeName(use.parent)) return nullptr;
  const auto made = use.context.plugins().modules().Create(use.Get("type").value, use.parent,
                                                           use.Get("name").value);
  if (made) {
    use.context.Defer(BuildStage::kConstruction, [use, module = *made] {
      const auto constructed = Runtime::Construct(*module);
      if (constructed) return;
      use.context.MarkUnbuilt(*module);
      use.context.Report(constructed.error(), use.xml.position(), *module);
    });
    return *made;
  }
  Error error = made.error();
  error.path = use.path();
  use.Report(std::move(error), use.xml.position());
  return nullptr;
}

std::vector<SavedTag> SavedModules(FrameworkElement& parent) {
  std::vector<SavedTag> tags;
  for (FrameworkElement* child : parent.children()) {
    if (!internal::IsSaved(*child) || !IsModule(*child)) continue;
    tags.push_back({{{"name", child->name()}, {"type", MadeByRule::Before(*child, FindModuleType(*child))}}, child});
  }
  return tags;
}

}  // namespace

XmlTag ModuleTag() {
  return {.name = "module",
          .summary = "a module of a type that a plugin brings",
          .parents = {"application", "group"},
          .attributes = {{.name = "name", .kind = AttributeKind::kNewName, .required = true},
                         {.name = "type",
                          .kind = AttributeKind::kModuleType,
                          .required = true,
                          .summary = "as `runnel modules` lists them"}},
          .is_structure = true,
          .handle = MakeModule,
          .saved = SavedModules,
          .place = 2};
}

}  // namespace runnel

#include "plugins/runtime_construction/build_context.h"
#include "plugins/runtime_construction/tags/built_in_tags.h"

namespace runnel {

namespace {

FrameworkElement* MakeModule(const TagUse& use) {
  if (!use.HasFreeName(use.parent)) return nullptr;
  const auto made = use.context.plugins().modules().Create(use.Get("type").value, use.parent,
                                                           use.Get("name").value);
  if (made) return *made;
  Error error = made.error();
  error.path = use.path();
  use.Report(std::move(error), use.xml.position());
  return nullptr;
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
          .handle = MakeModule};
}

}  // namespace runnel

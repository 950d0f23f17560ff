#include "plugins/runtime_construction/build_context.h"
#include "plugins/runtime_construction/module_type_hint.h"
#include "plugins/runtime_construction/name_check.h"
#include "plugins/runtime_construction/tags/built_in_tags.h"

namespace runnel {

namespace {

std::vector<std::string> TypeNames(const ModuleRegistry& modules) {
  std::vector<std::string> names;
  for (const ModuleType* type : modules.All()) names.push_back(type->name);
  return names;
}

FrameworkElement* MakeModule(const TagUse& use) {
  BuildContext& context = use.context;
  const XmlAttribute& type = use.Get("type");
  const ModuleRegistry& modules = context.plugins().modules();
  const auto report = [&](Error error, const SourcePosition& position) {
    error.path = use.path();
    context.Report(std::move(error), position, use.parent);
  };
  const std::string name = FreeName(use, use.parent);
  if (const auto known = modules.Get(type.value); !known) {
    if (context.IsWorthReporting(type.value, TypeNames(modules))) {
      report(
          {.message = known.error().message, .hint = ModuleTypeHint(type.value, context.plugins())},
          type.value_position);
    }
    return nullptr;
  }
  const auto made = modules.Create(type.value, use.parent, name);
  if (made) return *made;
  report(made.error(), use.xml.position());
  return nullptr;
}

}  // namespace

XmlTag ModuleTag() {
  return {.name = "module",
          .summary = "a module of a type that a plugin brings",
          .parents = {"application", "group"},
          .attributes = {{.name = "name", .kind = AttributeKind::kNewName, .required = true},
                         {.name = "type",
                          .kind = AttributeKind::kPath,
                          .required = true,
                          .summary = "as `runnel modules` lists them"}},
          .handle = MakeModule};
}

}  // namespace runnel

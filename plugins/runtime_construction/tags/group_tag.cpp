#include "core/module/group.h"
#include "plugins/runtime_construction/build_context.h"
#include "plugins/runtime_construction/name_check.h"
#include "plugins/runtime_construction/tags/built_in_tags.h"

namespace runnel {

XmlTag GroupTag() {
  return {.name = "group",
          .summary = "modules and groups that serve one purpose",
          .parents = {"application", "group"},
          .attributes = {{.name = "name", .kind = AttributeKind::kNewName, .required = true}},
          .handle = [](const TagUse& use) -> FrameworkElement* {
            return &use.context.runtime().Create<Group>(use.parent, FreeName(use, use.parent));
          }};
}

}  // namespace runnel

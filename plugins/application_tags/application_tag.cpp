#include "core/module/group.h"
#include "plugins/application_files/build_context.h"
#include "plugins/application_tags/tag_list.h"

namespace runnel {

XmlTag ApplicationTag() {
  return {.name = "application",
          .summary = "a group that holds everything",
          .parents = {},
          .attributes = {{.name = "name",
                          .kind = AttributeKind::kNewName,
                          .required = true,
                          .summary = "the first part of all paths"}},
          .is_structure = true,
          .handle = [](const TagUse& use) -> FrameworkElement* {
            if (!use.HasFreeName(use.parent)) return nullptr;
            return &use.context.runtime().Create<Group>(use.parent, use.Get("name").value);
          }};
}

}  // namespace runnel

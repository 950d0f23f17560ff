#include "plugins/application_files/build_context.h"
#include "plugins/application_files/tags/built_in_tags.h"

namespace runnel {

// What is read of it goes into the group that uses it: it makes nothing itself.
XmlTag GroupTypeTag() {
  return {.name = "group_type",
          .summary = "what is in every <group> whose type is this file",
          .parents = {},
          .attributes = {{.name = "description"}},
          .is_part = true,
          .handle = [](const TagUse& use) -> FrameworkElement* { return &use.parent; }};
}

}  // namespace runnel

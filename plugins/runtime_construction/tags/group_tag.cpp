#include <memory>
#include <utility>

#include "core/module/group.h"
#include "plugins/runtime_construction/application_reader.h"
#include "plugins/runtime_construction/tags/built_in_tags.h"

namespace runnel {

namespace {

void RefuseContents(const TagUse& use, const FrameworkElement& group) {
  for (const XmlElement child : use.xml.children()) {
    const XmlTag* const known = use.context.tags().FindTag(child.name());
    if (known == nullptr || child.name() == "parameter") continue;
    use.context.Report({.message = "<" + child.name() + "> in a group whose type is a file",
                        .hint = "write it into " + use.Get("type").value + ", or leave out type"},
                       child.position(), group);
  }
}

FrameworkElement* MakeGroup(const TagUse& use) {
  BuildContext& context = use.context;
  if (!use.HasFreeName(use.parent)) return nullptr;
  auto& group = context.runtime().Create<Group>(use.parent, use.Get("name").value);
  const XmlAttribute* const type = use.Find("type");
  if (type == nullptr) return &group;
  RefuseContents(use, group);
  if (auto read = ReadGroupType(*type, use.xml, group, context); !read) {
    context.MarkMissing(group, nullptr);
    context.Report(read.error(), type->value_position, group);
  }
  return &group;
}

}  // namespace

XmlTag GroupTag() {
  return {.name = "group",
          .summary = "modules and groups that serve one purpose",
          .parents = {"application", "group"},
          .attributes = {{.name = "name", .kind = AttributeKind::kNewName, .required = true},
                         {.name = "type",
                          .kind = AttributeKind::kPath,
                          .summary = "the file that says what is in it, a <group_type>"}},
          .is_structure = true,
          .handle = MakeGroup};
}

}  // namespace runnel

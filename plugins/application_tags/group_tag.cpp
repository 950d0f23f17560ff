// The tree of an application: groups and modules.

#include <memory>

#include "core/element/file_notes.h"
#include "core/module/group.h"
#include "core/plugin/module_type_name.h"
#include "plugins/application_files/application_builder.h"
#include "plugins/application_files/build_context.h"
#include "plugins/application_files/saving/saving.h"
#include "plugins/application_tags/tag_list.h"
#include "plugins/parameters/value_to_save.h"

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
  group.Annotate(std::make_unique<SourcePlace>(use.xml.position()));  // errors in the file name it
  RefuseContents(use, group);
  if (auto read = ReadGroupType(*type, use.xml, group, context); !read) {
    context.MarkMissing(group, nullptr);
    context.Report(read.error(), type->value_position, group);
  }
  return &group;
}

std::vector<SavedTag> SavedGroups(FrameworkElement& parent) {
  std::vector<SavedTag> tags;
  for (FrameworkElement* child : parent.children()) {
    if (!internal::IsSaved(*child) || IsModule(*child)) continue;
    tags.push_back({{{"name", child->name()}}, child});
    if (child->FindAnnotation<PartInstance>() == nullptr) continue;
    tags.back().attributes.push_back({.name = "type", .value = "", .is_kept = true});
  }
  return tags;
}

FrameworkElement* MakeModule(const TagUse& use) {
  if (!use.HasFreeName(use.parent)) return nullptr;
  const auto made = use.context.plugins().modules().Create(use.Get("type").value, use.parent, use.Get("name").value);
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

XmlTag ApplicationTag() {
  return {.name = "application",
          .summary = "a group that holds everything",
          .parents = {},
          .attributes = {KindRule("name", AttributeKind::kNewName, "the first part of all paths", true)},
          .is_structure = true,
          .handle = [](const TagUse& use) -> FrameworkElement* {
            if (!use.HasFreeName(use.parent)) return nullptr;
            return &use.context.runtime().Create<Group>(use.parent, use.Get("name").value);
          }};
}

XmlTag GroupTag() {
  return {.name = "group",
          .summary = "modules and groups that serve one purpose",
          .parents = {"application", "group"},
          .attributes = {{.name = "name", .kind = AttributeKind::kNewName, .required = true},
                         KindRule("type", AttributeKind::kPath, "the file that says what is in it, a <group_type>")},
          .is_structure = true,
          .handle = MakeGroup,
          .saved = SavedGroups,
          .place = 3};
}

XmlTag ModuleTag() {
  return {.name = "module",
          .summary = "a module of a type that a plugin brings",
          .parents = {"application", "group"},
          .attributes = {{.name = "name", .kind = AttributeKind::kNewName, .required = true},
                         KindRule("type", AttributeKind::kModuleType, "as `runnel modules` lists them", true)},
          .is_structure = true,
          .handle = MakeModule,
          .saved = SavedModules,
          .place = 2};
}

// What is read of it goes into the group that uses it: it makes nothing itself.
XmlTag GroupTypeTag() {
  return {.name = "group_type",
          .summary = "what is in every <group> whose type is this file",
          .parents = {},
          .attributes = {{.name = "description"}},
          .is_part = true};
}

}  // namespace runnel

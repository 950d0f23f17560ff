#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/conversion/value_part.h"
#include "core/element/file_notes.h"
#include "core/port/proxy_port.h"
#include "core/types/type_info.h"
#include "plugins/application_files/build_context.h"
#include "plugins/application_files/path_use.h"
#include "plugins/application_tags/tag_list.h"

namespace runnel {

namespace {

// The far end of `connect`, if it is a connection of the port called `own` seen from `base`.
std::optional<std::pair<PathUse, PathKind>> FarEnd(XmlElement connect, FrameworkElement& base, const std::string& own) {
  const XmlAttribute* const from = connect.Attribute("from");
  const XmlAttribute* const to = connect.Attribute("to");
  if (connect.name() != "connect" || from == nullptr || to == nullptr) return std::nullopt;
  const std::vector<PathUse> targets = PathsIn(*to, base);
  if (from->value == own && !targets.empty()) {
    return std::pair(targets.front(), PathKind::kInput);
  }
  const auto is_own = [&](const PathUse& target) { return target.path == own; };
  if (std::ranges::none_of(targets, is_own)) return std::nullopt;
  return std::pair(PathIn(*from, base), PathKind::kOutput);
}

// What the connections of a port say of its type.
struct Told {
  const TypeInfo* type = nullptr;  // of the first that leads to a port that is there
  bool misses_end = false;         // another end is not there
};

Told TypeAmong(XmlElement element, FrameworkElement& base, const std::string& own) {
  Told told;
  for (const XmlElement child : element.children()) {
    const auto far_end = FarEnd(child, base, own);
    // What comes out of a conversion cannot be told from what goes in.
    if (!far_end || child.Attribute("convert") != nullptr) continue;
    const auto found = PathSearch(base).FindPortPart(far_end->first.path, far_end->second);
    const auto part = found ? ValuePart::In(found->port->type(), found->part) : Result<ValuePart>(Error{});
    if (part) return {.type = &part->type()};
    const bool may_be_missing = child.Attribute("when") != nullptr;
    told.misses_end = told.misses_end || (!found && !may_be_missing);
  }
  return told;
}

const TypeInfo* ConnectedType(const TagUse& use) {
  const std::string& name = use.Get("name").value;
  XmlElement group = *use.xml.parent();
  const Told inside = TypeAmong(group, use.parent, name);
  if (inside.type != nullptr) return inside.type;
  // What is outside of a part stands where the part is used.
  if (const PartUse* part = use.context.parts().Find(use.parent)) group = part->tag;
  FrameworkElement& outside = *use.parent.parent();
  const std::string seen_from_outside = use.parent.name() + "/" + name;
  const Told around = TypeAmong(*group.parent(), outside, seen_from_outside);
  if (around.type != nullptr) return around.type;
  // The error that has been told already is why; without one, nobody else would tell that the port is missing.
  if (!use.context.ok() && (inside.misses_end || around.misses_end)) return nullptr;
  use.Report({.message = "the type of this port cannot be told from its connections", .hint = "add type=\"…\""},
             use.xml.position());
  return nullptr;
}

void MakePort(const TagUse& use) {
  if (!use.HasFreeName(use.parent)) return;
  const XmlAttribute& name = use.Get("name");
  const XmlAttribute* const named = use.Find("type");
  const TypeInfo* const type = named != nullptr ? FindType(named->value) : ConnectedType(use);
  if (type == nullptr) return use.context.MarkMissing(use.parent, &name);
  const auto direction = use.Get("direction").value == "input" ? Port::Direction::kInput : Port::Direction::kOutput;
  auto& port =
      use.context.runtime().Create<ProxyPort>(use.parent, name.value, direction, *type, use.xml.TextOr("description"));
  port.Annotate(std::make_unique<SourcePlace>(use.xml.position()));
}

std::vector<SavedTag> SavedPorts(FrameworkElement& group) {
  std::vector<SavedTag> tags;
  for (FrameworkElement* child : group.children()) {
    const auto* const port = dynamic_cast<const ProxyPort*>(child);
    if (port == nullptr) continue;
    const bool is_input = port->direction() == Port::Direction::kInput;
    tags.push_back({{{"name", port->name()},
                     {"direction", is_input ? "input" : "output"},
                     {"type", port->type().name()},
                     {"description", port->description(), port->description().empty()}},
                    child});
  }
  return tags;
}

}  // namespace

XmlTag PortTag() {
  return {
      .name = "port",
      .summary = "a port in the interface of its group; costs nothing at run time",
      .parents = {"group"},
      .attributes =
          {{.name = "name", .kind = AttributeKind::kNewName, .required = true},
           WordRule("direction", {"input", "output"}, "as seen from outside of the group", true),
           KindRule(
               "type", AttributeKind::kPortType,
               "of its values; if left out, that of what it is first connected to, inside the group or else outside"),
           {.name = "description", .kind = AttributeKind::kText}},
      .is_structure = true,
      .handle = internal::ReadAt<BuildStage::kInterfaces, MakePort>,
      .saved = SavedPorts,
      .place = 1};
}

}  // namespace runnel

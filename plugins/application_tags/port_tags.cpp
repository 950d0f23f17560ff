#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/number_text.h"
#include "core/conversion/value_part.h"
#include "core/element/file_notes.h"
#include "core/port/port_options.h"
#include "core/port/proxy_port.h"
#include "core/types/text_format.h"
#include "core/types/type_info.h"
#include "core/types/type_of.h"
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

AnyValue internal::ReadValue(const TagUse& use, const XmlAttribute& text, const Port& input) {
  const TypeInfo& type = input.type();
  const std::shared_ptr<void> value = type.is_transparent() ? type.Make() : nullptr;
  if (!value) {
    use.Report({.message = "values of type " + type.name() + " cannot be written", .path = input.path()},
               text.value_position);
    return {};
  }
  if (auto set = SetFromText(type, text.value, value.get()); !set) {
    use.Report({.message = set.error().message, .path = input.path(), .hint = set.error().hint}, text.value_position);
    return {};
  }
  return {type, value};
}

namespace {

void SetInputLimits(const TagUse& use) {
  Port* const input = SearchPort(PathIn(use.Get("name"), use.parent), PathKind::kInput, use.context);
  if (input == nullptr) return;
  InputLimits limits;
  const auto number = [&](const char* name) -> std::optional<double> {
    const XmlAttribute* const said = use.Find(name);
    return said != nullptr ? NumberIn<double>(said->value) : std::nullopt;
  };
  limits.minimum = number("minimum");
  limits.maximum = number("maximum");
  if (const XmlAttribute* const default_value = use.Find("default")) {
    limits.default_value = internal::ReadValue(use, *default_value, *input);
    if (!limits.default_value) return;
  }
  limits.out_of_bounds = internal::Chosen<OutOfBounds>(use, "out_of_bounds", OutOfBoundsNames());
  if (!limits.has_some()) {
    use.Report(
        {.message = "<input> says nothing of its values", .hint = "add default=\"…\", minimum=\"…\" or maximum=\"…\""},
        use.xml.position());
    return;
  }
  if (auto set = input->SetLimits(limits); !set) {
    use.Report(set.error(), use.xml.position());
    return;
  }
  input->Annotate(std::make_unique<GivenLimits>(std::move(limits)));
}

std::vector<SavedTag> SavedLimits(FrameworkElement& module) {
  std::vector<SavedTag> tags;
  module.VisitAll<const Port>([&](const Port& port) {
    const auto* const given = port.FindAnnotation<GivenLimits>();
    if (given == nullptr || !given->limits.has_some()) return;
    const InputLimits& limits = given->limits;
    const auto bound = [](const std::optional<double>& value) { return value ? TextOf(*value) : std::string(); };
    const std::string text = limits.default_value ? ToText(port.type(), limits.default_value.get()) : std::string();
    const auto out = static_cast<std::size_t>(limits.out_of_bounds);
    tags.push_back({{{"name", port.name()},
                     {"default", text, !limits.default_value},
                     {"minimum", bound(limits.minimum), !limits.minimum},
                     {"maximum", bound(limits.maximum), !limits.maximum},
                     {"out_of_bounds", OutOfBoundsNames()[out], out == 0}},
                    nullptr});
  });
  return tags;
}

}  // namespace

XmlTag InputTag() {
  return {.name = "input",
          .summary = "which values an input of the module takes, and what it reads while there is none",
          .parents = {"module"},
          .attributes = {{.name = "name", .kind = AttributeKind::kPath, .required = true},
                         {.name = "default", .summary = "read while nothing is connected, or nothing has come"},
                         {.name = "minimum", .kind = AttributeKind::kNumber},
                         {.name = "maximum", .kind = AttributeKind::kNumber},
                         WordRule("out_of_bounds", OutOfBoundsNames(),
                                  "what becomes of a value that is not between them: discard "
                                  "(by default), clamp, or default")},
          .handle = internal::ReadAt<BuildStage::kParameters, SetInputLimits>,
          .saved = SavedLimits,
          .place = 1};
}

}  // namespace runnel

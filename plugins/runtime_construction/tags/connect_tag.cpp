#include <string>
#include <vector>

#include "core/types/type_info.h"
#include "plugins/runtime_construction/build_context.h"
#include "plugins/runtime_construction/interface_direction.h"
#include "plugins/runtime_construction/path_use.h"
#include "plugins/runtime_construction/port_search.h"
#include "plugins/runtime_construction/tags/built_in_tags.h"

namespace runnel {

namespace {

const std::vector<std::string> kOnFullNames{"drop_oldest", "drop_newest", "refuse"};

constexpr std::size_t kLongestQueue = 1'000'000;

void ReadQueue(const TagUse& use, ConnectOptions& options) {
  const XmlAttribute* const queue = use.Find("queue");
  if (queue == nullptr) return;
  const std::size_t length = ParseCount(queue->value).value();
  if (length <= kLongestQueue) {
    options.queue = length;
    return;
  }
  use.context.Report({.message = "a queue of " + queue->value + " values is too long",
                      .hint = "its memory is taken at once; at most " +
                              std::to_string(kLongestQueue) + " values may wait"},
                     queue->value_position, use.parent);
}

ConnectOptions ReadOptions(const TagUse& use) {
  ConnectOptions options;
  ReadQueue(use, options);
  const XmlAttribute* const on_full = use.Find("on_full");
  if (on_full == nullptr) return options;
  if (on_full->value == "drop_newest") options.on_full = OnFull::kDropNewest;
  if (on_full->value == "refuse") options.on_full = OnFull::kRefuse;
  const XmlAttribute* const queue = use.Find("queue");
  const bool has_none =
      queue == nullptr ? !use.Says("queue") : ParseCount(queue->value).value() == 0;
  if (has_none) {
    use.context.Report({.message = "on_full has no meaning without a queue",
                        .hint = "add queue=\"…\" with a count above 0, or leave out on_full"},
                       on_full->position, use.parent);
  }
  return options;
}

// Other inputs beside `to` that would take what `from` carries.
std::string FittingInputs(const Port& from, const Port& to) {
  std::string names;
  for (const FrameworkElement* each : to.parent()->children()) {
    const auto* const port = dynamic_cast<const Port*>(each);
    if (port == nullptr || port->direction() != to.direction()) continue;
    if (&port->type() == &from.type()) names += (names.empty() ? "'" : ", '") + port->name() + "'";
  }
  return names.empty() ? "" : from.type().name() + " is taken by " + names;
}

// A connection fails: the module that it was meant for may have no other one.
void ExcuseModuleOf(const Port& port, BuildContext& context) {
  for (const FrameworkElement* each = &port; each != nullptr; each = each->parent()) {
    if (each->kind() == ElementKind::kModule) return context.Excuse(*each);
  }
  context.Excuse(port);
}

void Connect(Port& from, const PathUse& from_use, Port& to, const PathUse& to_use,
             const ConnectOptions& options, BuildContext& context) {
  CheckInterfaceDirection(from, from_use, ConnectionEnd::kFrom, to, context);
  CheckInterfaceDirection(to, to_use, ConnectionEnd::kTo, from, context);
  const auto connected = Port::Connect(from, to, options);
  if (connected) return;
  const bool cannot_send = !from.is_proxy() && from.direction() == Port::Direction::kInput;
  ExcuseModuleOf(to, context);
  if (cannot_send) ExcuseModuleOf(from, context);
  Error error = connected.error();
  if (error.hint.empty() && &from.type() != &to.type()) error.hint = FittingInputs(from, to);
  const PathUse& wrong = cannot_send ? from_use : to_use;
  context.Report(std::move(error), wrong.position, wrong.base);
}

// Nobody knows what was to be fed: all that could have been.
void ExcuseInputsFor(const Port* from, FrameworkElement& group, BuildContext& context) {
  group.Visit([&](FrameworkElement& element) {
    const auto* const port = dynamic_cast<const Port*>(&element);
    if (port == nullptr || port->direction() != Port::Direction::kInput) return;
    if (from == nullptr || &port->type() == &from->type()) context.Excuse(*port);
  });
}

std::vector<PathUse> Paths(const TagUse& use, std::string_view attribute) {
  const XmlAttribute* found = use.Find(attribute);
  if (found == nullptr) found = use.xml.Attribute(attribute);  // there, but wrong
  return found == nullptr ? std::vector<PathUse>() : PathsIn(*found, use.parent);
}

// Also of a tag that lacks an end: the other one is looked at all the same.
void ConnectAll(const TagUse& use) {
  BuildContext& context = use.context;
  const ConnectOptions options = ReadOptions(use);
  const std::vector<PathUse> sources = Paths(use, "from");
  if (sources.size() > 1) {
    context.Report(
        {.message = "a connection comes from one port", .hint = "write a <connect> for each"},
        sources[1].position, use.parent);
  }
  Port* const from =
      sources.empty() ? nullptr : SearchPort(sources[0], ConnectionEnd::kFrom, context);
  const std::vector<PathUse> targets = Paths(use, "to");
  for (const PathUse& to_use : targets) {
    Port* const to = SearchPort(to_use, ConnectionEnd::kTo, context);
    if (to == nullptr) continue;
    if (from == nullptr) {
      ExcuseModuleOf(*to, context);
    } else {
      Connect(*from, sources[0], *to, to_use, options, context);
    }
  }
  if (targets.empty()) ExcuseInputsFor(from, use.parent, context);
}

void DeferConnecting(const TagUse& use) {
  use.context.Defer(BuildStage::kConnections, [use] { ConnectAll(use); });
}

}  // namespace

XmlTag ConnectTag() {
  return {.name = "connect",
          .summary = "lets data flow from one port to others",
          .parents = {"application", "group"},
          .attributes = {{.name = "from",
                          .kind = AttributeKind::kPath,
                          .required = true,
                          .summary = "an output, or an interface port"},
                         {.name = "to",
                          .kind = AttributeKind::kPathList,
                          .required = true,
                          .summary = "inputs or interface ports, separated by blanks"},
                         {.name = "queue",
                          .kind = AttributeKind::kCount,
                          .summary = "how many values may wait at the input; 0: the latest counts"},
                         {.name = "on_full",
                          .kind = AttributeKind::kChoice,
                          .summary = "what a full queue does with one more value",
                          .choices = kOnFullNames}},
          .handle = [](const TagUse& use) -> FrameworkElement* {
            DeferConnecting(use);
            return &use.parent;
          },
          .salvage = DeferConnecting};
}

}  // namespace runnel

#include <string>
#include <vector>

#include "core/plugin/module_type_name.h"
#include "core/types/type_info.h"
#include "plugins/runtime_construction/build_context.h"
#include "plugins/runtime_construction/interface_direction.h"
#include "plugins/runtime_construction/path_use.h"
#include "plugins/runtime_construction/tags/built_in_tags.h"

namespace runnel {

namespace {

const std::vector<std::string> kOnFullNames{"drop_oldest", "drop_newest", "refuse"};

constexpr std::size_t kLongestQueue = 1'000'000;

ConnectOptions ReadOptions(const TagUse& use) {
  ConnectOptions options;
  if (const XmlAttribute* const queue = use.Find("queue")) {
    options.queue = ParseCount(queue->value).value();
    if (options.queue > kLongestQueue) {
      use.Report({.message = "a queue of " + queue->value + " values is too long",
                  .hint = "its memory is taken at once; at most " + std::to_string(kLongestQueue) +
                          " values may wait"},
                 queue->value_position);
      options.queue = 0;
      return options;
    }
  }
  const XmlAttribute* const on_full = use.Find("on_full");
  if (on_full == nullptr) return options;
  if (on_full->value == "drop_newest") options.on_full = OnFull::kDropNewest;
  if (on_full->value == "refuse") options.on_full = OnFull::kRefuse;
  if (options.queue == 0) {
    use.Report({.message = "on_full has no meaning without a queue",
                .hint = "add queue=\"…\" with a count above 0, or leave out on_full"},
               on_full->position);
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

// Another port of the module may have been meant.
void MarkUnfed(const Port& port, BuildContext& context) {
  const FrameworkElement* const module = FindModuleAround(port);
  context.MarkUnfed(module != nullptr ? *module : port);
}

void Connect(Port& from, const PathUse& from_use, Port& to, const PathUse& to_use,
             const ConnectOptions& options, BuildContext& context) {
  CheckInterfaceDirection(from, from_use, PathKind::kOutput, to, context);
  CheckInterfaceDirection(to, to_use, PathKind::kInput, from, context);
  const auto connected = Port::Connect(from, to, options);
  if (connected) return;
  const bool cannot_send = !from.is_proxy() && from.direction() == Port::Direction::kInput;
  MarkUnfed(to, context);
  if (cannot_send) MarkUnfed(from, context);
  Error error = connected.error();
  if (error.hint.empty() && &from.type() != &to.type()) error.hint = FittingInputs(from, to);
  const PathUse& wrong = cannot_send ? from_use : to_use;
  context.Report(std::move(error), wrong.position, wrong.base);
}

void ConnectAll(const TagUse& use) {
  BuildContext& context = use.context;
  const ConnectOptions options = ReadOptions(use);
  const std::vector<PathUse> sources = PathsIn(use.Get("from"), use.parent);
  if (sources.size() > 1) {
    use.Report({.message = "a connection comes from one port", .hint = "write a <connect> for each"},
               sources[1].position);
  }
  Port* const from = SearchPort(sources[0], PathKind::kOutput, context);
  for (const PathUse& to_use : PathsIn(use.Get("to"), use.parent)) {
    Port* const to = SearchPort(to_use, PathKind::kInput, context);
    if (to == nullptr) continue;
    if (from == nullptr) {
      MarkUnfed(*to, context);
    } else {
      Connect(*from, sources[0], *to, to_use, options, context);
    }
  }
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
          .is_structure = true,
          .handle = [](const TagUse& use) -> FrameworkElement* {
            use.context.Defer(BuildStage::kConnections, [use] { ConnectAll(use); });
            return &use.parent;
          }};
}

}  // namespace runnel

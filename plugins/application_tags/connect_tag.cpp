#include <string>
#include <utility>
#include <vector>

#include "core/paths/distant_ports.h"
#include "core/paths/late_connections.h"
#include "core/plugin/module_type_name.h"
#include "core/types/type_info.h"
#include "plugins/application_files/build_context.h"
#include "plugins/application_files/path_use.h"
#include "plugins/application_tags/tag_list.h"

namespace runnel {

namespace {

ConnectOptions ReadOptions(const TagUse& use) {
  ConnectOptions options;
  if (const XmlAttribute* const queue = use.Find("queue")) {
    options.queue = ParseCount(queue->value).value();
    if (options.queue > ConnectOptions::kLongestQueue) {
      use.Report({.message = "a queue of " + queue->value + " values is too long",
                  .hint = "its memory is taken at once; at most " + std::to_string(ConnectOptions::kLongestQueue) +
                          " values may wait"},
                 queue->value_position);
      options.queue = 0;
      return options;
    }
  }
  const XmlAttribute* const pull = use.Find("pull");
  options.pull = use.xml.TextOr("pull") == "true";
  if (options.pull && options.queue > 0) {
    use.Report({.message = "a connection that pulls cannot have a queue",
                .hint = "what is pulled is the newest value; leave out one of the two"},
               pull->position);
    options.pull = false;
  }
  options.convert = use.xml.TextOr("convert");
  options.late = use.xml.TextOr("late") == "true";
  options.when_present = use.Find("when") != nullptr;
  const XmlAttribute* const on_full = use.Find("on_full");
  if (on_full == nullptr) return options;
  options.on_full = internal::Chosen<OnFull>(use, "on_full", OnFullNames());
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

void Connect(Port& from, const PathUse& from_use, Port& to, const PathUse& to_use, const ConnectOptions& options,
             BuildContext& context) {
  CheckInterfaceDirection(from, from_use, PathKind::kOutput, to, context);
  CheckInterfaceDirection(to, to_use, PathKind::kInput, from, context);
  if (options.when_present) (void)LateConnections::Of(from.runtime());
  const auto connected = Port::Connect(from, to, options);
  if (connected) return;
  const bool cannot_send = !from.is_proxy() && from.direction() == Port::Direction::kInput;
  MarkUnfed(to, context);
  if (cannot_send) MarkUnfed(from, context);
  Error error = connected.error();
  if (&from.type() != &to.type() && options.part.empty() && options.convert.empty()) {
    const std::string fitting = FittingInputs(from, to);
    if (!fitting.empty()) error.hint = fitting + (error.hint.empty() ? "" : "; ") + error.hint;
  }
  const bool cannot_be_pulled = options.pull && !from.is_pullable();
  const bool is_source = cannot_send || cannot_be_pulled || !options.part.empty();
  const PathUse& wrong = is_source ? from_use : to_use;
  context.Report(std::move(error), wrong.position, wrong.base);
}

// Of a connection that is to be when its ends are there, one that is not.
bool AwaitsEnd(const TagUse& use, const PathUse& from, const PathUse& to, const ConnectOptions& options) {
  Port* const target = FindPort(to, PathKind::kInput);
  const bool may_wait = options.when_present || (target != nullptr && IsDistantPath(from.path));
  if (!may_wait || (target != nullptr && FindPort(from, PathKind::kOutput) != nullptr)) return false;
  if (target != nullptr) use.context.MarkUnfed(*target);
  const auto added =
      LateConnections::Of(use.context.runtime()).Add(internal::AbsolutePath(from), internal::AbsolutePath(to), options);
  if (!added) use.context.Report(added.error(), to.position, to.base);
  return true;
}

void ConnectAll(const TagUse& use) {
  BuildContext& context = use.context;
  ConnectOptions options = ReadOptions(use);
  std::vector<PathUse> sources = PathsIn(use.Get("from"), use.parent);
  if (sources.size() > 1) {
    use.Report({.message = "a connection comes from one port", .hint = "write a <connect> for each"},
               sources[1].position);
  }
  options.part = internal::TakePart(sources[0]);
  std::vector<PathUse> targets;
  for (const PathUse& to_use : PathsIn(use.Get("to"), use.parent)) {
    const Port* const to = FindPort(to_use, PathKind::kInput);
    const auto brought = to != nullptr ? BringDistantPort(sources[0].path, *to, options) : Result<void>();
    if (!brought) {
      MarkUnfed(*to, context);
      return use.Report(brought.error(), sources[0].position);
    }
    if (!AwaitsEnd(use, sources[0], to_use, options)) targets.push_back(to_use);
  }
  if (targets.empty()) return;
  Port* const from = SearchPort(sources[0], PathKind::kOutput, context);
  for (const PathUse& to_use : targets) {
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
          .attributes =
              {KindRule("from", AttributeKind::kPath, "an output, or an interface port", true),
               KindRule("to", AttributeKind::kPathList, "inputs or interface ports, separated by blanks", true),
               KindRule("queue", AttributeKind::kCount, "how many values may wait at the input; 0: the latest counts"),
               WordRule("on_full", OnFullNames(), "what a full queue does with one more value"),
               YesNoRule("pull",
                         "whether reading the input first has its sources make a value; "
                         "false by default, and not with a queue"),
               {.name = "convert",
                .summary = "by which conversion values become those of the input: round, truncate, parse, or what a "
                           "plugin has registered; needed only where something is lost, or several lead there"},
               WordRule("when", {"present"},
                        "present: made as soon as both ends are there, and again after "
                        "one went; without, they must be there from the start"),
               YesNoRule("late", "true: in a loop of modules, the connection by which values come one cycle late")},
          .is_structure = true,
          .handle = internal::ReadAt<BuildStage::kConnections, ConnectAll>,
          .update = internal::UpdateConnect,
          .missing = internal::MissingConnections,
          .place = 4};
}

}  // namespace runnel

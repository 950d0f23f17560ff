#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/element/element_path.h"
#include "core/paths/distant_ports.h"
#include "core/paths/late_connections.h"
#include "core/plugin/module_type_name.h"
#include "core/port/parameter_input.h"
#include "core/types/type_info.h"
#include "plugins/application_files/build_context.h"
#include "plugins/application_files/path_use.h"
#include "plugins/application_files/saving/file_update.h"
#include "plugins/application_tags/tag_list.h"

namespace runnel {

namespace {

constexpr std::size_t kLongestQueue = 1'000'000;

ConnectOptions ReadOptions(const TagUse& use) {
  ConnectOptions options;
  if (const XmlAttribute* const queue = use.Find("queue")) {
    options.queue = ParseCount(queue->value).value();
    if (options.queue > kLongestQueue) {
      use.Report({.message = "a queue of " + queue->value + " values is too long",
                  .hint = "its memory is taken at once; at most " + std::to_string(kLongestQueue) + " values may wait"},
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

// <connect>, as the files that are saved have it.
namespace runnel::internal {

std::string TakePart(PathUse& use) {
  const auto found = PathSearch(use.base).FindPortPart(use.path, PathKind::kOutput);
  const std::string part = found ? found->part : "";
  PortPathPart split{use.path, part};
  if (!part.empty()) split.path.resize(split.path.size() - part.size() - (part.front() == '[' ? 0 : 1));
  const bool is_parent = use.path == ".." || use.path.ends_with("/..");
  if (!found && !is_parent) split = SplitPortPath(use.path);  // perhaps the port is not there yet
  use.path = split.path;
  return split.part;
}

std::string AbsolutePath(const PathUse& use) {
  if (IsAbsolutePath(use.path)) return use.path;
  std::string path = std::filesystem::path(use.base.path() + "/" + use.path).lexically_normal().string();
  if (path.ends_with('/')) path.pop_back();
  return path;
}

namespace {

std::string RelativePath(const FrameworkElement& home, const std::string& path) {
  return path.starts_with(home.path() + "/") ? path.substr(home.path().size() + 1) : path;
}

// As short as it may be, seen from `home`.
std::string PathFrom(FrameworkElement& home, const Port& port, PathKind kind) {
  if (const std::string& distant = DistantPathOf(port); !distant.empty()) return distant;
  const std::string full = LastingPath(port).substr(home.path().size() + 1);
  const FrameworkElement* group = port.parent();
  const FrameworkElement* const fed = ParameterSetBy(port);
  if (fed != nullptr) group = fed->parent();
  if (group->kind() != ElementKind::kPortGroup) return full;
  std::string module = group->parent()->path().substr(home.path().size());
  if (!module.empty()) module.erase(0, 1);
  const std::string shorter = module + "/" + (fed != nullptr ? fed : &port)->name();
  return FindPort({home, shorter, {}}, kind) == &port ? shorter : full;
}

std::string PartText(const ConnectOptions& options) {
  const std::string& part = options.part;
  return (part.empty() || part.front() == '[' ? "" : ".") + part;
}

struct OptionText {
  AttributeRule rule;
  std::string usual;
  std::string value;
  friend bool operator==(const OptionText& a, const OptionText& b) { return a.value == b.value; }
};

// What a file says of a connection; it need not say what is usual.
std::array<OptionText, 6> TextsOf(const ConnectOptions& options) {
  const OnFull on_full = options.queue > 0 ? options.on_full : OnFull::kDropOldest;
  return {{{{.name = "queue", .kind = AttributeKind::kCount}, "0", std::to_string(options.queue)},
           {{.name = "on_full"}, OnFullNames()[0], OnFullNames()[static_cast<std::size_t>(on_full)]},
           {{.name = "pull"}, "false", options.pull ? "true" : "false"},
           {{.name = "convert"}, "", options.convert},
           {{.name = "when"}, "", options.when_present ? "present" : ""},
           {{.name = "late"}, "false", options.late ? "true" : "false"}}};
}

bool SaysOptions(XmlElement tag, const ConnectOptions& options) {
  return std::ranges::all_of(TextsOf(options), [&](const OptionText& each) {
    return MeanTheSame(each.rule, tag.TextOr(each.rule.name, each.usual), each.value);
  });
}

// Whether a tag says it already; if not, and the tag may be changed, the tag says it from now on.
bool SaysConnection(XmlElement tag, const PathUse& from_use, const std::string& part, const PathUse& to_use,
                    bool is_only_one, FileUpdate& update) {
  Port* const from = FindPort(from_use, PathKind::kOutput);
  Port* const to = FindPort(to_use, PathKind::kInput);
  const bool is_there = from != nullptr && to != nullptr;
  std::vector<SavedEdge>& edges = update.saving().edges;
  const LateConnections* const late = is_there ? nullptr : LateConnections::FindIn(from_use.base.runtime());
  const LateConnection* const awaited =
      late != nullptr ? late->Find(AbsolutePath(from_use), AbsolutePath(to_use)) : nullptr;
  const auto edge = std::ranges::find_if(edges, [&](const SavedEdge& each) {
    if (is_there) return each.from == from && each.to == to;
    if (to != nullptr && each.to == to && each.from_path == from_use.path) return true;
    return awaited != nullptr && each.from_path == awaited->from && each.to_path == awaited->to;
  });
  // One that leads out of the application is left to whoever wrote it.
  if (edge == edges.end() && is_there && from->ConnectionTo(*to) != nullptr) return true;
  if (edge == edges.end() || edge->is_saved) {
    update.Touch(from);
    update.Touch(to);
    return false;
  }
  const bool is_same_part = part == edge->options.part;
  if (!is_same_part || !SaysOptions(tag, edge->options)) {
    if (!is_only_one) return false;
    if (!is_same_part) {
      update.editor().SetAttribute(tag, "from", from_use.path + PartText(edge->options));
    }
    for (const auto& [rule, usual, value] : TextsOf(edge->options)) {
      value == usual ? update.editor().RemoveAttribute(tag, rule.name)
                     : update.editor().SetAttribute(tag, rule.name, value);
    }
  }
  edge->is_saved = true;
  return true;
}

}  // namespace

void UpdateConnect(XmlElement tag, FrameworkElement& group, FileUpdate& update) {
  const XmlAttribute& to_list = *tag.Attribute("to");
  PathUse from = PathIn(*tag.Attribute("from"), group);
  const std::string part = TakePart(from);
  const std::vector<PathUse> targets = PathsIn(to_list, group);
  std::set<std::size_t> gone;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (!SaysConnection(tag, from, part, targets[i], targets.size() == 1, update)) gone.insert(i);
  }
  if (gone.size() == targets.size()) {
    update.editor().Remove(tag);
  } else {
    update.editor().RemoveWords(to_list, gone);
  }
}

std::vector<NewElement> MissingConnections(const XmlElement*, FrameworkElement& home, Saving& saving, FileUpdate*) {
  std::vector<NewElement> elements;
  const SavedEdge* last = nullptr;
  for (SavedEdge& edge : saving.edges) {
    if (edge.is_saved || edge.home != &home) continue;
    edge.is_saved = true;
    const std::string to =
        edge.to != nullptr ? PathFrom(home, *edge.to, PathKind::kInput) : RelativePath(home, edge.to_path);
    const std::string from =
        edge.from != nullptr ? PathFrom(home, *edge.from, PathKind::kOutput) : RelativePath(home, edge.from_path);
    const bool goes_on = last != nullptr && last->from == edge.from && last->from_path == edge.from_path &&
                         last->options.part == edge.options.part && TextsOf(last->options) == TextsOf(edge.options);
    last = &edge;
    if (goes_on) {
      elements.back().attributes[1].second += " " + to;
      continue;
    }
    NewElement& made = elements.emplace_back(
        NewElement{.name = "connect", .attributes = {{"from", from + PartText(edge.options)}, {"to", to}}});
    for (const auto& [rule, usual, value] : TextsOf(edge.options)) {
      if (value != usual) made.attributes.emplace_back(rule.name, value);
    }
  }
  return elements;
}

}  // namespace runnel::internal

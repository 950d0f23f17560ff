#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/plugin/module_type_name.h"
#include "core/types/type_info.h"
#include "plugins/application_files/build_context.h"
#include "plugins/application_files/path_use.h"
#include "plugins/application_files/saving/file_update.h"
#include "plugins/application_files/tags/built_in_tags.h"

namespace runnel {

namespace {

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
  const XmlAttribute* const pull = use.Find("pull");
  options.pull = pull != nullptr && pull->value == "true";
  if (options.pull && options.queue > 0) {
    use.Report({.message = "a connection that pulls cannot have a queue",
                .hint = "what is pulled is the newest value; leave out one of the two"},
               pull->position);
    options.pull = false;
  }
  const XmlAttribute* const on_full = use.Find("on_full");
  if (on_full == nullptr) return options;
  const auto name = std::ranges::find(OnFullNames(), on_full->value);
  options.on_full = static_cast<OnFull>(name - OnFullNames().begin());
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
  const bool cannot_be_pulled = options.pull && !from.is_pullable();
  const PathUse& wrong = cannot_send || cannot_be_pulled ? from_use : to_use;
  context.Report(std::move(error), wrong.position, wrong.base);
}

void ConnectAll(const TagUse& use) {
  BuildContext& context = use.context;
  const ConnectOptions options = ReadOptions(use);
  const std::vector<PathUse> sources = PathsIn(use.Get("from"), use.parent);
  if (sources.size() > 1) {
    use.Report(
        {.message = "a connection comes from one port", .hint = "write a <connect> for each"},
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

// Saving.

// As short as it may be, seen from `home`.
std::string PathFrom(FrameworkElement& home, const Port& port, PathKind kind) {
  const std::string full = LastingPath(port).substr(home.path().size() + 1);
  const FrameworkElement* group = port.parent();
  const FrameworkElement* const fed = group->parent();
  const bool is_feed = fed != nullptr && fed->kind() == ElementKind::kParameter;
  if (is_feed) group = fed->parent();
  if (group->kind() != ElementKind::kPortGroup) return full;
  std::string module = group->parent()->path().substr(home.path().size());
  if (!module.empty()) module.erase(0, 1);
  const std::string shorter = module + "/" + (is_feed ? *fed : port).name();
  return FindPort({home, shorter, {}}, kind) == &port ? shorter : full;
}

struct OptionText {
  AttributeRule rule;
  std::string usual;
  std::string value;
  friend bool operator==(const OptionText& a, const OptionText& b) { return a.value == b.value; }
};

// What a file says of a connection; it need not say what is usual.
std::array<OptionText, 3> TextsOf(const ConnectOptions& options) {
  const OnFull on_full = options.queue > 0 ? options.on_full : OnFull::kDropOldest;
  return {
      {{{.name = "queue", .kind = AttributeKind::kCount}, "0", std::to_string(options.queue)},
       {{.name = "on_full"}, OnFullNames()[0], OnFullNames()[static_cast<std::size_t>(on_full)]},
       {{.name = "pull"}, "false", options.pull ? "true" : "false"}}};
}

bool SaysOptions(XmlElement tag, const ConnectOptions& options) {
  return std::ranges::all_of(TextsOf(options), [&](const OptionText& each) {
    const XmlAttribute* const said = tag.Attribute(each.rule.name);
    return internal::MeanTheSame(each.rule, said != nullptr ? said->value : each.usual, each.value);
  });
}

// Whether a tag says it already; if not, and the tag may be changed, the tag says it from now on.
bool SaysConnection(XmlElement tag, Port* from, Port* to, bool is_only_one,
                    internal::FileUpdate& update) {
  const bool is_there = from != nullptr && to != nullptr;
  std::vector<internal::SavedEdge>& edges = update.saving().edges;
  const auto edge = std::ranges::find_if(
      edges, [&](const auto& each) { return each.from == from && each.to == to; });
  // One that leads out of the application is left to whoever wrote it.
  if (edge == edges.end() && is_there &&
      std::ranges::find(from->outgoing(), to, &Connection::to) != from->outgoing().end()) {
    return true;
  }
  if (edge == edges.end() || edge->is_saved) {
    update.Touch(from);
    update.Touch(to);
    return false;
  }
  if (!SaysOptions(tag, edge->options)) {
    if (!is_only_one) return false;
    for (const auto& [rule, usual, value] : TextsOf(edge->options)) {
      value == usual ? update.editor().RemoveAttribute(tag, rule.name)
                     : update.editor().SetAttribute(tag, rule.name, value);
    }
  }
  edge->is_saved = true;
  return true;
}

void UpdateConnect(XmlElement tag, FrameworkElement& group, internal::FileUpdate& update) {
  const XmlAttribute& to_list = *tag.Attribute("to");
  Port* const from = FindPort(PathIn(*tag.Attribute("from"), group), PathKind::kOutput);
  const std::vector<PathUse> targets = PathsIn(to_list, group);
  std::set<std::size_t> gone;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    Port* const to = FindPort(targets[i], PathKind::kInput);
    if (!SaysConnection(tag, from, to, targets.size() == 1, update)) gone.insert(i);
  }
  if (gone.size() == targets.size()) {
    update.editor().Remove(tag);
  } else {
    update.editor().RemoveWords(to_list, gone);
  }
}

// Of the connections that no tag says yet; those of one port together.
std::vector<NewElement> MissingConnections(FrameworkElement& home, internal::Saving& saving) {
  std::vector<NewElement> elements;
  const internal::SavedEdge* last = nullptr;
  for (internal::SavedEdge& edge : saving.edges) {
    if (edge.is_saved || edge.home != &home) continue;
    edge.is_saved = true;
    const std::string to = PathFrom(home, *edge.to, PathKind::kInput);
    const bool goes_on = last != nullptr && last->from == edge.from &&
                         TextsOf(last->options) == TextsOf(edge.options);
    last = &edge;
    if (goes_on) {
      elements.back().attributes[1].second += " " + to;
      continue;
    }
    NewElement& made = elements.emplace_back(NewElement{
        .name = "connect",
        .attributes = {{"from", PathFrom(home, *edge.from, PathKind::kOutput)}, {"to", to}}});
    for (const auto& [rule, usual, value] : TextsOf(edge.options)) {
      if (value != usual) made.attributes.emplace_back(rule.name, value);
    }
  }
  return elements;
}

}  // namespace

XmlTag ConnectTag() {
  return {
      .name = "connect",
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
                      .choices = OnFullNames()},
                     {.name = "pull",
                      .kind = AttributeKind::kChoice,
                      .summary = "whether reading the input first has its sources make a value; "
                                 "false by default, and not with a queue",
                      .choices = {"false", "true"}}},
      .is_structure = true,
      .handle = [](const TagUse& use) -> FrameworkElement* {
        use.context.Defer(BuildStage::kConnections, [use] { ConnectAll(use); });
        return &use.parent;
      },
      .update = UpdateConnect,
      .missing = [](const XmlElement*, FrameworkElement& home, internal::Saving& saving,
                    internal::FileUpdate*) { return MissingConnections(home, saving); },
      .place = 4};
}

}  // namespace runnel

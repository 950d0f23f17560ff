// What is done about modules that are stuck or paused, and what is measured of them.

#include "core/types/duration_text.h"
#include "plugins/application_files/path_use.h"
#include "plugins/application_tags/run_description.h"
#include "plugins/application_tags/tag_list.h"
#include "plugins/supervision/stop_button.h"

namespace runnel {

namespace {

template <void (*kRead)(const TagUse& use)>
FrameworkElement* InTheEnd(const TagUse& use) {
  use.context.Defer(BuildStage::kChecks, [use] { kRead(use); });
  return &use.parent;
}

void AddWatch(const TagUse& use) {
  const FrameworkElement* const of = SearchElement(PathIn(use.Get("of"), use.parent), use.context);
  const Reaction first = internal::ReadReaction(use.xml, use.parent, use.context);
  Reaction otherwise;
  for (const XmlElement child : use.xml.children()) {
    if (child.name() == "otherwise") otherwise = internal::ReadReaction(child, use.parent, use.context);
  }
  if (of == nullptr) return;
  otherwise.TakeBack(first);
  RunRules& rules = internal::RunRulesAround(use.parent);
  if (const XmlAttribute* const after = use.Find("after")) {
    rules.stuck_reactions.push_back({of->path(), ParseDuration(after->value).value(), first, otherwise});
  } else {
    rules.pause_reactions.push_back({of->path(), first, otherwise});
  }
}

void AddLatency(const TagUse& use) {
  const Port* const from = SearchPort(PathIn(use.Get("from"), use.parent), PathKind::kOutput, use.context);
  const Port* const to = SearchPort(PathIn(use.Get("to"), use.parent), PathKind::kOutput, use.context);
  if (from == nullptr || to == nullptr) return;
  const LatencyRequest request{from->path(), to->path()};
  const auto path = FindDataPath(use.context.runtime().root(), request);
  if (!path) return use.Report(path.error(), use.Get("to").value_position);
  internal::RunRulesAround(use.parent).latencies.push_back(request);
}

void AddStopButton(const TagUse& use) {
  const XmlAttribute* const releases = use.Find("releases");
  const Port* const port = SearchPort(PathIn(use.Get("port"), use.parent), PathKind::kOutput, use.context);
  if (port == nullptr) return;
  if (auto good = CheckStopButton(*port); !good) return use.Report(good.error(), use.Get("port").value_position);
  internal::RunRulesAround(use.parent).stop_buttons.push_back({port->path(), releases && releases->value == "true"});
}

// Nobody changes it while the application runs, so the file keeps it.
FrameworkElement* WatchOperators(const TagUse& use) {
  constexpr Duration kShortest = std::chrono::milliseconds(200);
  constexpr Duration kLongest = std::chrono::minutes(10);
  RunRules& rules = internal::RunRulesAround(use.parent);
  const Duration timeout = ParseDuration(use.Get("timeout").value).value();
  if (rules.operators_timeout) {
    use.Report({.message = "how long operators may be silent is said twice"}, use.xml.position());
  } else if (timeout < kShortest || timeout > kLongest) {
    use.Report({.message = "operators may be silent for 200ms to 10min"}, use.Get("timeout").value_position);
  }
  rules.operators_timeout = timeout;
  return &use.parent;
}

void BeginProfile(const TagUse& use) { internal::RunRulesAround(use.parent).is_profiled = true; }

// Of a thread or of the whole application. Nobody changes it while the application runs, so the file keeps it.
void LimitStuck(const XmlAttribute& after, FrameworkElement& element, BuildContext&) {
  const bool is_application = element.parent()->parent() == nullptr;
  internal::RunRulesAround(element).stuck_limits.emplace_back(is_application ? "" : element.path(),
                                                              ParseDuration(after.value).value());
}

}  // namespace

AddedAttribute StuckAfterAttribute(std::string tag) {
  return {.tag = std::move(tag),
          .rule = {.name = "stuck_after",
                   .kind = AttributeKind::kDuration,
                   .summary = "a module that does not return from its cycle for so long is told as "
                              "stuck, by the machine's "
                              "clock; without it, 1s"},
          .handle = LimitStuck};
}

XmlTag OnStuckTag() {
  return {
      .name = "on_stuck",
      .summary =
          "what happens when a module does not return from its cycle; it is told of in any case",
      .parents = {"application", "group"},
      .attributes = {PathRule("of", true, "a module, or a group of which any module may be stuck"),
                     {.name = "after",
                      .kind = AttributeKind::kDuration,
                      .required = true,
                      .summary = "the longest time in one cycle, by the machine's clock"}},
      .handle = InTheEnd<AddWatch>};
}
XmlTag OnPauseTag() {
  return {.name = "on_pause",
          .summary = "what happens when somebody pauses modules, once they stand still",
          .parents = {"application", "group"},
          .attributes = {PathRule("of", true, "a module, or a group of which any module may be paused")},
          .handle = InTheEnd<AddWatch>};
}
XmlTag StopButtonTag() {
  return {.name = "stop_button",
          .summary = "a port by which somebody presses the STOP of the robot: true, or a number that is not 0",
          .parents = {"application", "group"},
          .attributes = {PathRule("port", true, "what publishes the state of the button"),
                         {.name = "releases",
                          .kind = AttributeKind::kChoice,
                          .summary = "whether letting go of the button releases the STOP; else somebody has to do so",
                          .choices = {"false", "true"}}},
          .handle = InTheEnd<AddStopButton>};
}
XmlTag OperatorsTag() {
  return {.name = "operators",
          .summary = "an operator must be heard: else the STOP of the robot is pressed; operators are pages, terminals, "
                     "Python and Foxglove that may drive",
          .parents = {"application"},
          .attributes = {{.name = "timeout",
                          .kind = AttributeKind::kDuration,
                          .required = true,
                          .summary = "so long all of them may be silent, from the start on; by the machine's clock"}},
          .handle = WatchOperators};
}
XmlTag LatencyTag() {
  return {.name = "latency",
          .summary = "measures how old what a command goes back to is, along the modules in between",
          .parents = {"application", "group"},
          .attributes = {PathRule("from", true, "a sensor's output; its values say when they were measured"),
                         PathRule("to", true, "a command's output")},
          .handle = InTheEnd<AddLatency>};
}
XmlTag ProfileTag() {
  return {.name = "profile",
          .summary = "measures from the start how long each module takes",
          .parents = {"application"},
          .handle = InTheEnd<BeginProfile>};
}

}  // namespace runnel

// What is done about inputs that fall silent and modules that fail, are stuck or paused, and what is measured of them.

#include <utility>

#include "core/base/clock.h"
#include "core/types/duration_text.h"
#include "plugins/application_files/path_use.h"
#include "plugins/application_tags/run_description.h"
#include "plugins/application_tags/tag_list.h"
#include "plugins/supervision/stop_button.h"

namespace runnel {

namespace {

template <void (*kRead)(const TagUse& use)>
constexpr auto InTheEnd = internal::ReadAt<BuildStage::kChecks, kRead>;

using When = SupervisionRule::When;

// What it watches; "" after reporting what is wrong with it.
std::string WatchedBy(const TagUse& use, When when) {
  if (when != When::kStale) {
    const FrameworkElement* const of = SearchElement(PathIn(use.Get("of"), use.parent), use.context);
    return of != nullptr ? of->path() : "";
  }
  const XmlAttribute& input = use.Get("input");
  const Port* const port = SearchPort(PathIn(input, use.parent), PathKind::kInput, use.context);
  if (port == nullptr) return "";
  if (!port->Sources().empty()) return port->path();
  if (!use.context.ok() && !use.context.IsUnfedUnnoticed(*port)) return "";
  use.context.Report({.message = "cannot become stale, as nothing is connected to it",
                      .path = port->path(),
                      .hint = "connect it, or leave out <on_stale>"},
                     input.value_position, use.parent);
  return "";
}

// What the attributes of <on_fault> say is to be done.
void ReadFaultAttributes(const TagUse& use, Reaction& reaction) {
  const XmlAttribute* const set = use.Find("set");
  const XmlAttribute* const value = use.Find("value");
  reaction.ends_run = reaction.ends_run || use.Find("action") != nullptr;
  if (set == nullptr || value == nullptr) return;
  const FrameworkElement* const target = SearchSettable(*set, *value, use.parent, use.context);
  if (target == nullptr) return;
  reaction.changes.push_back(SetParameter{target->path(), value->value});
  reaction.description = "set " + target->path() + " to " + value->value;
}

template <When kWhen>
void AddRule(const TagUse& use) {
  SupervisionRule rule;
  rule.when = kWhen;
  rule.position = use.xml.position();
  if (const XmlAttribute* const after = use.Find("after")) rule.after = ParseDuration(after->value).value();
  const XmlAttribute* const fresh_after = use.Find("fresh_after");
  rule.fresh_after = fresh_after ? ParseDuration(fresh_after->value).value()
                                 : SaturatingSum(Time(rule.after), rule.after).time_since_epoch();
  rule.reaction = internal::ReadReaction(use.xml, use.parent, use.context);
  if (kWhen == When::kFault) ReadFaultAttributes(use, rule.reaction);
  for (const XmlElement child : use.xml.children()) {
    if (child.name() == "otherwise") rule.otherwise = internal::ReadReaction(child, use.parent, use.context);
  }
  rule.otherwise.TakeBack(rule.reaction);
  rule.of = WatchedBy(use, kWhen);
  if (!rule.of.empty()) internal::RunRulesAround(use.parent).rules.push_back(std::move(rule));
}

FrameworkElement* HandleOnStale(const TagUse& use) {
  if (use.xml.children().empty()) {
    use.context.Report({.message = "<on_stale> does not say what is to be done",
                        .hint = "put <publish>, <switch>, <set>, <replace> or <quit> into it"},
                       use.xml.position(), use.parent);
  }
  return InTheEnd<AddRule<When::kStale>>(use);
}

FrameworkElement* HandleOnFault(const TagUse& use) {
  const bool acts = use.Find("action") != nullptr;
  const bool sets = use.Find("set") != nullptr;
  const bool has_value = use.Find("value") != nullptr;
  const bool has_tags = !use.xml.children().empty();
  if (acts + sets + has_tags != 1) {
    use.Report({.message = "<on_fault> must say one thing that is to be done",
                .hint = "write either action=\"quit\" or set=\"…\" value=\"…\""},
               use.xml.position());
  }
  if (sets != has_value) {
    use.Report({.message = sets ? "<on_fault> does not say to which value" : "'value' needs a 'set'",
                .hint = sets ? "add value=\"…\"" : "add set=\"…\", or leave out value"},
               use.xml.position());
  }
  return InTheEnd<AddRule<When::kFault>>(use);
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
  const Port* const port = SearchPort(PathIn(use.Get("port"), use.parent), PathKind::kOutput, use.context);
  if (port == nullptr) return;
  const StopButtonRule rule{port->path(), use.xml.TextOr("releases") == "true"};
  if (auto good = CheckStopButton(*port, rule.releases); !good)
    return use.Report(good.error(), use.Get("port").value_position);
  internal::RunRulesAround(use.parent).stop_buttons.push_back(rule);
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

Result<void> AddRules(const FrameworkElement& application, Scheduler& scheduler, Supervisor& supervisor) {
  const auto* const rules = application.FindAnnotation<RunRules>();
  if (rules == nullptr) return {};
  for (const auto& [of, after] : rules->stuck_limits) (void)scheduler.SetStuckLimit(of, after);
  for (const SupervisionRule& rule : rules->rules) {
    if (auto added = supervisor.Add(rule); !added) return added;
  }
  for (const StopButtonRule& rule : rules->stop_buttons) {
    if (auto added = supervisor.Add(rule); !added) return added;
  }
  for (const LatencyRequest& each : rules->latencies) {
    if (auto added = scheduler.AddLatency(each); !added) return added;
  }
  if (rules->is_profiled) scheduler.SetProfiled(true);
  return {};
}

FrameworkElement& internal::ApplicationOf(FrameworkElement& element) {
  FrameworkElement* at = &element;
  while (at->parent()->parent() != nullptr) at = at->parent();
  return *at;
}

RunRules& internal::RunRulesAround(FrameworkElement& element) {
  return ApplicationOf(element).FindOrAnnotate<RunRules>();
}

AddedAttribute StuckAfterAttribute(std::string tag) {
  return {.tag = std::move(tag),
          .rule = KindRule("stuck_after", AttributeKind::kDuration,
                           "a module that does not return from its cycle for so long is told as stuck, by the "
                           "machine's clock; without it, 1s"),
          .handle = LimitStuck};
}

std::vector<XmlTag> internal::WatchingTags() {
  return {
      {.name = "on_fault",
       .summary = "what happens when a module has thrown, and so has failed",
       .parents = {"application", "group"},
       .attributes = {PathRule("of", true, "a module, or a group of which any module may fail"),
                      WordRule("action", {"quit"}),
                      PathRule("set", false, "a parameter that may be set at run time"),
                      {.name = "value", .summary = "what it is set to"}},
       .handle = HandleOnFault},
      {.name = "on_stale",
       .summary = "what happens when an input brings nothing new for too long",
       .parents = {"application", "group"},
       .attributes = {PathRule("input", true, "what feeds it when the run begins is watched"),
                      KindRule("after", AttributeKind::kDuration,
                               "the longest time without anything new, by the application's clock", true),
                      KindRule(
                          "fresh_after", AttributeKind::kDuration,
                          "how long values must come again before <otherwise> is done; twice 'after' if left out")},
       .handle = HandleOnStale},
      {.name = "on_stuck",
       .summary = "what happens when a module does not return from its cycle; it is told of in any case",
       .parents = {"application", "group"},
       .attributes = {PathRule("of", true, "a module, or a group of which any module may be stuck"),
                      KindRule("after", AttributeKind::kDuration,
                               "the longest time in one cycle, by the machine's clock", true)},
       .handle = InTheEnd<AddRule<When::kStuck>>},
      {.name = "on_pause",
       .summary = "what happens when somebody pauses modules, once they stand still",
       .parents = {"application", "group"},
       .attributes = {PathRule("of", true, "a module, or a group of which any module may be paused")},
       .handle = InTheEnd<AddRule<When::kPaused>>},
      {.name = "stop_button",
       .summary = "a port by which somebody presses the STOP of the robot: true, or a number that is not 0",
       .parents = {"application", "group"},
       .attributes = {PathRule("port", true, "what publishes the state of the button"),
                      YesNoRule("releases",
                                "whether letting go of the button releases the STOP, if the port is the output of "
                                "its own driver; else somebody has to do so")},
       .handle = InTheEnd<AddStopButton>},
      {.name = "operators",
       .summary = "an operator must be heard: else the STOP of the robot is pressed; operators are pages, terminals "
                  "and Python that may drive",
       .parents = {"application"},
       .attributes = {KindRule("timeout", AttributeKind::kDuration,
                               "so long all of them may be silent, from the start on; by the machine's clock", true)},
       .handle = WatchOperators},
      {.name = "latency",
       .summary = "measures how old what a command goes back to is, along the modules in between",
       .parents = {"application", "group"},
       .attributes = {PathRule("from", true, "a sensor's output; its values say when they were measured"),
                      PathRule("to", true, "a command's output")},
       .handle = InTheEnd<AddLatency>},
      {.name = "profile",
       .summary = "measures from the start how long each module takes",
       .parents = {"application"},
       .handle = InTheEnd<BeginProfile>},
      {.name = "otherwise",
       .summary = "what happens when the input is fresh again, the module has returned or goes on",
       .parents = {"on_stale", "on_stuck", "on_pause"}}};
}

}  // namespace runnel

#include "core/paths/path_search.h"
#include "core/types/duration_text.h"
#include "plugins/control/command.h"
#include "plugins/scheduling/scheduler.h"

namespace runnel {

namespace {

std::string LimitText(Duration after) {
  return after > Duration{} ? ": at most " + DurationText(after) + " in a cycle\n"
                            : ": no deadline\n";
}

std::string StuckText(const Scheduler& scheduler) {
  std::string text;
  for (const StuckRule& rule : scheduler.StuckRules()) {
    text += (rule.of.empty() ? "all others" : rule.of) + LimitText(rule.after);
  }
  if (text.empty()) text = "no module has a deadline\n";
  for (const StuckModule& stuck : scheduler.StuckModules()) {
    text += stuck.path + " has not returned for " + DurationText(stuck.since) + "; " +
            stuck.thread + " waits for it\n";
  }
  return text;
}

}  // namespace

// What is shown needs no structure lock, so that it is shown although a module is stuck with that.
CommandResult MakeDeadlineCommand(const Request& request, const CommandContext& context) {
  Scheduler& scheduler = *context.application.scheduler;
  if (request.arguments.empty()) {
    return Command([&scheduler](Answer& answer) -> CommandStep {
      answer.Write(StuckText(scheduler));
      return ControlCode::kDone;
    });
  }
  if (request.arguments.size() == 1) {
    return Error{.message = "'deadline PATH' wants a time",
                 .hint = "for example 200ms; off: modules may take as long as they like"};
  }
  Duration after{};
  if (request.arguments[1] != "off") {
    const auto time = ParseDuration(request.arguments[1]);
    if (!time) return time.error();
    if (*time <= Duration::zero()) return Error{.message = "a deadline is longer than nothing"};
    after = *time;
  }
  Runtime& runtime = context.application.runtime;
  return Command(UnderLock(runtime, [&, after, path = request.arguments[0]](Answer& answer) -> CommandStep {
    const auto found = PathSearch(runtime).Find(path);
    if (!found) return Refuse(answer, found.error());
    if (auto set = scheduler.SetStuckLimit((*found)->path(), after); !set) {
      return Refuse(answer, set.error());
    }
    answer.Write((*found)->path() + LimitText(after));
    return ControlCode::kDone;
  }));
}

}  // namespace runnel

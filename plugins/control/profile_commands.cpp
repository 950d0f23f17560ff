// How long modules and chains of them take, and may take.

#include <memory>

#include <fmt/format.h>

#include "core/paths/path_search.h"
#include "core/types/duration_text.h"
#include "plugins/control/command.h"
#include "plugins/scheduling/scheduler.h"

namespace runnel {

namespace {

constexpr Duration kFrame = std::chrono::seconds(1);

// What one client looks at; modules are measured meanwhile.
struct Top {
  explicit Top(Scheduler& of) : scheduler(of), use(of) {}
  Scheduler& scheduler;
  Scheduler::ProfileUse use;
  Profile before = {};
  Time taken{};
  bool has_begun = false;
};

std::string LimitText(Duration after) {
  return after > Duration{} ? ": at most " + DurationText(after) + " in a cycle\n" : ": no deadline\n";
}

std::string StuckText(const Scheduler& scheduler) {
  std::string text;
  for (const StuckRule& rule : scheduler.StuckRules()) {
    text += (rule.of.empty() ? "all others" : rule.of) + LimitText(rule.after);
  }
  if (text.empty()) text = "no module has a deadline\n";
  for (const StuckModule& stuck : scheduler.StuckModules()) {
    text += stuck.path + " has not returned for " + DurationText(stuck.since) + "; " + stuck.thread + " waits for it\n";
  }
  return text;
}

}  // namespace

// Shares are of the time from one table to the next; all else is since the measuring began.
CommandResult MakeTopCommand(const Request& request, const CommandContext& context) {
  auto count = ReadCountOption(request);
  if (!count) return count.error();
  if (request.Has("once")) *count = 1;
  auto& runtime = context.application.runtime;
  return Command(UnderLock(
      runtime,
      [&runtime, zero = context.application.log.start(), left = *count, &scheduler = *context.application.scheduler,
       top = std::shared_ptr<Top>()](Answer& answer) mutable -> CommandStep {
        if (!top) top = std::make_shared<Top>(scheduler);
        const Time now = SteadyClock().Now();
        Profile profile = top->scheduler.ReadProfile();
        if (std::exchange(top->has_begun, true)) {
          answer.Write(fmt::format("{:.3f} s; measured for {:.1f} s\n", ToSeconds(runtime.clock().Now() - zero),
                                   ToSeconds(top->scheduler.profiled_for().value_or(Duration{}))) +
                       ProfileText(profile, now - top->taken, top->before));
          if (left && --*left == 0) return ControlCode::kDone;
        }
        top->before = std::move(profile);
        top->taken = now;
        return kFrame;
      }));
}

CommandResult MakeProfileCommand(const Request& request, const CommandContext& context) {
  Scheduler& scheduler = *context.application.scheduler;
  const std::string word = request.arguments.empty() ? "" : request.arguments[0];
  if (!word.empty() && word != "on" && word != "off")
    return Error{.message = "'" + word + "' is neither 'on' nor 'off'"};
  return Command(UnderLock(context.application.runtime, [&scheduler, word](Answer& answer) -> CommandStep {
    if (!word.empty()) {
      scheduler.SetProfiled(word == "on");
      return Say(answer, word == "on" ? "measures how long modules take\n" : "measures no more\n");
    }
    const auto measured = scheduler.profiled_for();
    if (!measured) return Say(answer, "nothing is measured; 'profile on' begins\n");
    return Say(answer, fmt::format("measured for {:.1f} s\n", ToSeconds(*measured)) +
                           ProfileText(scheduler.ReadProfile(), *measured));
  }));
}

CommandResult MakeLatencyCommand(const Request& request, const CommandContext& context) {
  Scheduler& scheduler = *context.application.scheduler;
  const auto& words = request.arguments;
  const bool ends = words.size() == 3 && words[2] == "off";
  if (words.size() == 1 || (words.size() == 3 && !ends)) {
    return Error{.message = "two ports are wanted, from which to which",
                 .hint = "for example: latency /laser/scan /planner/twist [off]"};
  }
  return Command(UnderLock(context.application.runtime, [&scheduler, words, ends](Answer& answer) -> CommandStep {
    if (words.empty()) {
      const std::string text = ProfileText({.tasks = {}, .latencies = scheduler.ReadLatencies()}, {});
      return Say(answer, text.empty() ? "no latency is measured\n" : text);
    }
    const auto done = ends ? scheduler.RemoveLatency({words[0], words[1]}) : scheduler.AddLatency({words[0], words[1]});
    if (!done) return Refuse(answer, done.error());
    return Say(answer, ends ? "measured no more\n"
                            : ProfileText({.tasks = {}, .latencies = {scheduler.ReadLatencies().back()}}, {}));
  }));
}

// What is shown needs no structure lock, so that it is shown although a module is stuck with that.
CommandResult MakeDeadlineCommand(const Request& request, const CommandContext& context) {
  Scheduler& scheduler = *context.application.scheduler;
  if (request.arguments.empty()) {
    return Command([&scheduler](Answer& answer) { return Say(answer, StuckText(scheduler)); });
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
    return Say(answer, (*found)->path() + LimitText(after));
  }));
}

}  // namespace runnel

#include "plugins/application/internal/run_loop.h"

#include <algorithm>
#include <thread>

namespace runnel::internal {

namespace {

bool IsOver(const RunLoop& loop, Duration so_far) {
  return loop.is_over(so_far) || loop.scheduler.stop_requested() ||
         (loop.limit && so_far >= *loop.limit);
}

Result<Duration> RunSimulated(const RunLoop& loop) {
  const Clock& clock = loop.runtime.clock();
  const Time start = clock.Now();
  const auto end = loop.limit ? std::optional(start + *loop.limit) : std::nullopt;
  for (;;) {
    if (!loop.scheduler.NextDue()) return NothingToRun();
    const auto result = loop.scheduler.Advance(end, kLookAround);
    const Duration so_far = clock.Now() - start;
    const bool is_at_the_end = end && result == Scheduler::StepResult::kEnd;
    if (is_at_the_end || IsOver(loop, so_far)) return so_far;
  }
}

// Looks around until `end`, whatever it sees.
void BringToRest(const RunLoop& loop, Time start, Time end) {
  const Clock& clock = loop.runtime.clock();
  for (Time now = clock.Now(); now < end; now = clock.Now()) {
    (void)loop.is_over(now - start);
    std::this_thread::sleep_for(kLookAround);
  }
}

Result<Duration> RunReal(const RunLoop& loop) {
  const Clock& clock = loop.runtime.clock();
  const Time start = clock.Now();
  if (auto started = loop.scheduler.Start(); !started) return started.error();
  Duration so_far{};
  while (!IsOver(loop, so_far)) {
    const Duration left = loop.limit ? *loop.limit - so_far : kLookAround;
    std::this_thread::sleep_for(std::min(left, kLookAround));
    so_far = clock.Now() - start;
  }
  if (loop.scheduler.stop_requested()) BringToRest(loop, start, clock.Now() + kGraceTime);
  so_far = clock.Now() - start;
  loop.scheduler.Stop();
  return so_far;
}

}  // namespace

Error NothingToRun() {
  return {.message = "there is nothing to run",
          .hint = "the application has no modules, or none that any thread would ever run"};
}

Result<Duration> Run(const RunLoop& loop) {
  if (!loop.scheduler.HasTasks()) return NothingToRun();
  const bool is_simulated =
      loop.scheduler.options().clock == SchedulerOptions::ClockKind::kSimulated;
  return is_simulated ? RunSimulated(loop) : RunReal(loop);
}

}  // namespace runnel::internal

#include "apps/runnel/running.h"

#include <algorithm>
#include <thread>

namespace runnel::program {

namespace {

constexpr Duration kLookAround = std::chrono::milliseconds(20);

Error NothingToRun() {
  return {.message = "there is nothing to run",
          .hint = "the application has no modules, or none that any thread would ever run"};
}

bool IsOver(const Running& running, Duration so_far) {
  return running.is_over(so_far) || running.scheduler.stop_requested() ||
         (running.limit && so_far >= *running.limit);
}

Result<Duration> RunSimulated(const Running& running) {
  const Clock& clock = running.runtime.clock();
  const Time start = clock.Now();
  const auto end = running.limit ? std::optional(start + *running.limit) : std::nullopt;
  for (;;) {
    if (!running.scheduler.NextDue()) return NothingToRun();
    const auto went = running.scheduler.GoOn(end, kLookAround);
    const Duration so_far = clock.Now() - start;
    const bool is_at_the_end = end && went == Scheduler::Went::kToTheEnd;
    if (is_at_the_end || IsOver(running, so_far)) return so_far;
  }
}

// Looks around until `end`, whatever it sees.
void BringToRest(const Running& running, Time start, Time end) {
  const Clock& clock = running.runtime.clock();
  for (Time now = clock.Now(); now < end; now = clock.Now()) {
    (void)running.is_over(now - start);
    std::this_thread::sleep_for(kLookAround);
  }
}

Result<Duration> RunReal(const Running& running) {
  const Clock& clock = running.runtime.clock();
  const Time start = clock.Now();
  if (auto started = running.scheduler.Start(); !started) return started.error();
  Duration so_far{};
  while (!IsOver(running, so_far)) {
    const Duration left = running.limit ? *running.limit - so_far : kLookAround;
    std::this_thread::sleep_for(std::min(left, kLookAround));
    so_far = clock.Now() - start;
  }
  if (running.scheduler.stop_requested()) BringToRest(running, start, clock.Now() + kGraceTime);
  so_far = clock.Now() - start;
  running.scheduler.Stop();
  return so_far;
}

}  // namespace

Result<Duration> Run(const Running& running) {
  if (!running.scheduler.HasTasks()) return NothingToRun();
  const bool is_simulated =
      running.scheduler.options().clock == SchedulerOptions::ClockKind::kSimulated;
  return is_simulated ? RunSimulated(running) : RunReal(running);
}

}  // namespace runnel::program

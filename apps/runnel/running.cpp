#include "apps/runnel/running.h"

#include <thread>

namespace runnel::program {

namespace {

constexpr auto kLookAround = std::chrono::milliseconds(20);

bool IsOver(const Running& running, Duration so_far) {
  return running.is_over(so_far) || running.scheduler.stop_requested() ||
         (running.limit && so_far >= *running.limit);
}

Result<Duration> RunSimulated(const Running& running) {
  const Time start = running.runtime.clock().Now();
  for (;;) {
    const bool has_run = running.scheduler.Step();
    const Duration so_far = running.runtime.clock().Now() - start;
    if (IsOver(running, so_far)) return so_far;
    if (!has_run) {
      return Error{.message = "there is nothing to run",
                   .hint = "the application has no modules, or none in a thread with a period"};
    }
  }
}

Result<Duration> RunReal(const Running& running) {
  const Time start = running.runtime.clock().Now();
  if (auto started = running.scheduler.Start(); !started) return started.error();
  Duration so_far{};
  while (!IsOver(running, so_far)) {
    std::this_thread::sleep_for(kLookAround);
    so_far = running.runtime.clock().Now() - start;
  }
  running.scheduler.Stop();
  return so_far;
}

}  // namespace

Result<Duration> Run(const Running& running) {
  const bool is_simulated =
      running.scheduler.options().clock == SchedulerOptions::ClockKind::kSimulated;
  return is_simulated ? RunSimulated(running) : RunReal(running);
}

}  // namespace runnel::program

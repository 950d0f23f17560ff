// What the Scheduler does between cycles: attends to faults, brings up to date what could not be at
// once, looks out, and has the watchdog name who does not return.

#include <exception>
#include <mutex>
#include <utility>

#include "core/base/exception_text.h"
#include "core/base/retry.h"
#include "plugins/scheduling/scheduler.h"

namespace runnel {

namespace {

// Without memory even for this there is nothing to tell it with; what has failed is tried again.
void ReportException(const char* what, const std::exception_ptr& exception, FaultDispatcher& faults,
                     Runtime& runtime) noexcept {
  try {
    faults.Report({runtime.root().path(), what + DescribeException(exception), runtime.clock().Now()});
  } catch (...) {
  }
}

}  // namespace

void Scheduler::Supervise() {
  while (supervises_.load(std::memory_order_acquire)) {
    if (watchdog_) {
      faults_.event().WaitUntil(next_watch_);
    } else {
      faults_.event().Wait();
    }
    Maintain();
    RunWatchdog();
  }
}

// Nobody is above the supervising thread to catch what it throws. What memory is too short for is tried for a
// while, with the lock free in between.
void Scheduler::Maintain() noexcept {
  std::exception_ptr failure;
  const bool is_done = Retry([&] {
    try {
      faults_.Dispatch();
      const std::lock_guard lock(runtime_.structure_mutex());
      if (is_running_) BringUpToDate();
    } catch (...) {
      failure = std::current_exception();
      throw;
    }
  });
  if (is_done) return;
  ReportException("the schedules could not be brought up to date: ", failure, faults_, runtime_);
}

void Scheduler::EndSupervision() {
  supervises_.store(false, std::memory_order_release);
  if (!supervisor_.joinable()) return;
  faults_.event().Notify();
  supervisor_.join();
  supervisor_ = std::thread();
}

void Scheduler::SetWatchdog(Watchdog watchdog) {
  RUNNEL_CHECK(!is_running(), "what looks out is chosen while nothing runs");
  watchdog_ = std::move(watchdog);
  next_watch_ = {};
}

void Scheduler::RunWatchdog() noexcept {
  if (!watchdog_) return;
  const Time now = runtime_.clock().Now();
  if (now < next_watch_) return;
  try {
    next_watch_ = watchdog_(now);
  } catch (...) {
    ReportException("the watchdog failed: ", std::current_exception(), faults_, runtime_);
    next_watch_ = now + std::chrono::seconds(1);
  }
}

void Scheduler::AddStuckRule(StuckRule rule) {
  cycle_watchdog_.Add(std::move(rule));
  const std::lock_guard lock(runtime_.structure_mutex());
  UpdateInstruments();
}

void Scheduler::SetStuckListener(std::function<void()> listener) {
  cycle_watchdog_.SetListener([this, listener = std::move(listener)] {
    faults_.Dispatch();
    if (listener) listener();
  });
}

Result<void> Scheduler::SetStuckLimit(const std::string& of, Duration after) {
  if (after < Duration::zero()) {
    return Error{.message = "a time that a module may take is positive", .path = of};
  }
  cycle_watchdog_.SetLimit(of, after);
  const std::lock_guard lock(runtime_.structure_mutex());
  UpdateInstruments();
  return {};
}

}  // namespace runnel

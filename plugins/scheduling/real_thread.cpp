#include "plugins/scheduling/real_thread.h"

#include <utility>

#include "core/lockfree/thread_epoch.h"
#include "plugins/scheduling/due_time.h"
#include "plugins/scheduling/realtime_setup.h"
#include "plugins/scheduling/sleep_until.h"

namespace runnel {

RealThread::RealThread(std::shared_ptr<CycleRunner> runner, FaultDesk& desk, Time first)
    : runner_(std::move(runner)), desk_(desk), thread_([this, first] { Run(first); }) {}

RealThread::~RealThread() {
  RequestStop();
  thread_.join();
}

std::optional<Error> RealThread::Prioritize() {
  const int priority = runner_->options().priority;
  if (priority == 0) return {};
  auto warning = UseFifoScheduling(thread_.native_handle(), priority);
  if (warning) warning->path = runner_->path();
  return warning;
}

void RealThread::RequestStop() noexcept {
  stopping_.store(true, std::memory_order_release);
  runner_->event().Notify();
}

void RealThread::Run(Time first) {
  { const EpochGuard registers_this_thread; }
  PrefaultStack();
  RunCycles(first);
  ended_.store(true, std::memory_order_release);
}

void RealThread::RunCycles(Time first) {
  switch (runner_->options().activation) {
    case ThreadOptions::Activation::kPeriod:
      return RunPeriodically(first);
    case ThreadOptions::Activation::kFreeRunning:
      return RunFreely();
    case ThreadOptions::Activation::kTrigger:
      return RunOnData();
  }
}

void RealThread::RunPeriodically(Time first) {
  const SteadyClock clock;
  const ThreadOptions& options = runner_->options();
  DueTime due(first, options.period, options.on_overrun);
  while (SleepUntil(due.next(), [this] { return stopping(); })) {
    const CycleTimes times{due.next(), clock.Now(), options.period};
    const Duration execution = runner_->RunCycle(times, desk_);
    const bool overrun = due.Advance(clock.Now());
    runner_->Record({times.due, times.now, execution, overrun});
  }
}

void RealThread::RunFreely() {
  while (!stopping()) RunUnplanned();
}

void RealThread::RunOnData() {
  for (;;) {
    // Data may have come while no thread was waiting for it.
    if (!runner_->is_activated()) runner_->event().Wait();
    if (stopping()) return;
    if (runner_->TakeActivation()) RunUnplanned();
  }
}

void RealThread::RunUnplanned() {
  const Time now = SteadyClock().Now();
  const Duration execution = runner_->RunCycle({now, now, Duration::zero()}, desk_);
  runner_->Record({now, now, execution, false});
}

}  // namespace runnel

#include "plugins/scheduling/simulated_executor.h"

#include <algorithm>
#include <string>
#include <utility>

namespace runnel {

void SimulatedExecutor::SetRunners(const std::vector<std::shared_ptr<CycleRunner>>& runners) {
  std::vector<PeriodicThread> periodic;
  std::vector<std::shared_ptr<CycleRunner>> waiting;
  for (const auto& runner : runners) {
    if (runner->waits_for_data()) {
      waiting.push_back(runner);
      continue;
    }
    const auto known = std::ranges::find(periodic_, runner, &PeriodicThread::runner);
    const ThreadOptions& options = runner->options();
    const DueTime at_once(clock_.Now(), options.period, options.on_overrun);
    periodic.push_back({runner, known == periodic_.end() ? at_once : known->due});
  }
  periodic_ = std::move(periodic);
  waiting_ = std::move(waiting);
}

void SimulatedExecutor::BeginAt(Time first) {
  clock_.Set(first);
  for (PeriodicThread& each : periodic_) {
    const ThreadOptions options = each.runner->options();
    each.due = DueTime(first, options.period, options.on_overrun);
  }
}

void SimulatedExecutor::FollowOptions() {
  for (PeriodicThread& each : periodic_) {
    const ThreadOptions options = each.runner->options();
    if (options.period == each.due.period()) continue;
    each.due.Change(options.period, options.on_overrun, clock_.Now());
  }
}

SimulatedExecutor::PeriodicThread* SimulatedExecutor::NextPeriodic() {
  // The first of several smallest: that of the container that was made first.
  const auto next =
      std::ranges::min_element(periodic_, {}, [](const PeriodicThread& thread) { return thread.due.next(); });
  return next == periodic_.end() ? nullptr : &*next;
}

CycleRunner* SimulatedExecutor::NextActivated() const {
  if (is_time_stuck_) return nullptr;
  const auto next = std::ranges::find_if(waiting_, [](const auto& runner) { return runner->is_activated(); });
  return next == waiting_.end() ? nullptr : next->get();
}

std::optional<Time> SimulatedExecutor::NextDue() {
  if (NextActivated() != nullptr) return clock_.Now();
  const PeriodicThread* const next = NextPeriodic();
  if (next == nullptr) return {};
  return std::max(next->due.next(), clock_.Now());
}

bool SimulatedExecutor::Step() {
  if (NextActivated() == nullptr) {
    PeriodicThread* const next = NextPeriodic();
    if (next == nullptr) return false;
    RunPeriodic(*next);
    is_time_stuck_ = false;
  }
  RunActivated();
  return true;
}

// Others may keep the runner between cycles; simulated time stands still meanwhile.
void SimulatedExecutor::RunCycle(CycleRunner& runner, const Cycle& cycle) {
  runner.quiescence()->Take();
  while (!runner.RunCycle(cycle, faults_)) runner.gate().WaitUntilOpen();
}

void SimulatedExecutor::RunPeriodic(PeriodicThread& thread) {
  const bool is_planned = thread.runner->options().activation == ThreadOptions::Activation::kPeriod;
  const Time due = thread.due.next();
  clock_.Set(due);
  const Time start = clock_.Now();  // later, if a module has let time pass in its cycle
  const Duration period = is_planned ? thread.runner->options().period : Duration::zero();
  const Time began = machine_.Now();
  RunCycle(*thread.runner, {start, period});
  const Duration execution = machine_.Now() - began;
  const bool overrun = thread.due.Advance(clock_.Now());
  thread.runner->Record({is_planned ? due : start, start, execution, is_planned && overrun});
  faults_.Dispatch();
}

void SimulatedExecutor::RunActivated() {
  for (int cycles = 0; !faults_.stop_requested(); ++cycles) {
    CycleRunner* const next = NextActivated();
    if (next == nullptr) return;
    if (cycles == kMostTriggeredCycles) return ReportEndlessLoop(*next);
    (void)next->TakeActivation();
    const Time now = clock_.Now();
    const Time began = machine_.Now();
    RunCycle(*next, {now, Duration::zero()});
    next->Record({now, now, machine_.Now() - began, false});
    faults_.Dispatch();
  }
}

void SimulatedExecutor::ReportEndlessLoop(const CycleRunner& runner) {
  is_time_stuck_ = true;
  if (std::exchange(endless_loop_is_reported_, true)) return;
  faults_.Report({runner.path(),
                  "modules set each other off without end while no time passes, " +
                      std::to_string(kMostTriggeredCycles) + " cycles until now",
                  clock_.Now()});
}

}  // namespace runnel

#include "plugins/scheduling/simulated_executor.h"

#include <algorithm>
#include <utility>

namespace runnel {

void SimulatedExecutor::SetRunners(const std::vector<std::shared_ptr<CycleRunner>>& runners) {
  const std::vector<Lane> before = std::exchange(periodic_, {});
  waiting_.clear();
  for (const auto& runner : runners) {
    if (runner->waits_for_data()) {
      waiting_.push_back(runner);
      continue;
    }
    const auto known = std::ranges::find(before, runner, &Lane::runner);
    const ThreadOptions& options = runner->options();
    const DueTime at_once(clock_.Now(), options.period, options.on_overrun);
    periodic_.push_back({runner, known == before.end() ? at_once : known->due});
  }
}

SimulatedExecutor::Lane* SimulatedExecutor::NextPeriodic() {
  // The first of several smallest: that of the container that was made first.
  const auto next =
      std::ranges::min_element(periodic_, {}, [](const Lane& lane) { return lane.due.next(); });
  return next == periodic_.end() ? nullptr : &*next;
}

CycleRunner* SimulatedExecutor::NextActivated() const {
  const auto next =
      std::ranges::find_if(waiting_, [](const auto& runner) { return runner->is_activated(); });
  return next == waiting_.end() ? nullptr : next->get();
}

std::optional<Time> SimulatedExecutor::NextDue() const {
  if (NextActivated() != nullptr) return clock_.Now();
  const Lane* const next = const_cast<SimulatedExecutor*>(this)->NextPeriodic();
  if (next == nullptr) return {};
  return std::max(next->due.next(), clock_.Now());
}

bool SimulatedExecutor::Step() {
  if (NextActivated() == nullptr) {
    Lane* const next = NextPeriodic();
    if (next == nullptr) return false;
    RunPeriodic(*next);
  }
  RunActivated();
  return true;
}

void SimulatedExecutor::RunPeriodic(Lane& lane) {
  const bool is_planned = lane.runner->options().activation == ThreadOptions::Activation::kPeriod;
  const Time due = lane.due.next();
  clock_.Set(due);
  const Time start = clock_.Now();  // later, if a module has let time pass in its cycle
  const Duration period = is_planned ? lane.runner->options().period : Duration::zero();
  const Duration execution = lane.runner->RunCycle({due, start, period}, desk_);
  const bool overrun = lane.due.Advance(clock_.Now());
  lane.runner->Record({is_planned ? due : start, start, execution, is_planned && overrun});
  desk_.Attend();
}

void SimulatedExecutor::RunActivated() {
  for (int cycles = 0; cycles < kMostTriggeredCycles && !desk_.stop_requested(); ++cycles) {
    CycleRunner* const next = NextActivated();
    if (next == nullptr) return;
    (void)next->TakeActivation();
    const Time now = clock_.Now();
    const Duration execution = next->RunCycle({now, now, Duration::zero()}, desk_);
    next->Record({now, now, execution, false});
    desk_.Attend();
  }
}

}  // namespace runnel

#include "plugins/scheduling/cycle_hold.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/lockfree/backoff.h"
#include "core/lockfree/thread_epoch.h"
#include "plugins/scheduling/cycle_runner.h"
#include "plugins/timing/cycle_tracer.h"

namespace runnel {

Result<CycleHold> CycleHold::Take(std::vector<std::shared_ptr<CycleRunner>> runners,
                                  Duration timeout, CycleTracer* tracer) {
  RUNNEL_CHECK(!EpochGuard::HeldByThisThread(),
               "threads cannot be kept between cycles from within a cycle");
  const SteadyClock clock;
  const Time deadline = SaturatingSum(clock.Now(), timeout);
  std::ranges::stable_sort(runners, std::ranges::greater{},
                           [](const auto& runner) { return runner->statistics().execution_mean; });
  CycleHold hold;
  hold.tracer_ = tracer;
  hold.began_ = clock.Now();
  hold.runners_.reserve(
      runners.size());  // whose gate is closed is known by the hold, whatever fails
  for (auto& runner : runners) {
    runner->gate().Close();
    hold.runners_.push_back(std::move(runner));
    const CycleRunner& closed = *hold.runners_.back();
    // Passes a heavy fence; see CycleGate.
    const std::uint64_t epoch = ProcessEpochs().Advance();
    for (int round = 0; !closed.quiescence()->HasLeft(epoch); ++round) {
      if (clock.Now() > deadline) {
        return Error{.message = "has not come to the end of its cycle in " +
                                std::to_string(ToSeconds(timeout)) + " s",
                     .path = closed.path(),
                     .hint = "one of its modules does not return from its Update()"};
      }
      BackOff(round);
    }
  }
  return hold;
}

void CycleHold::Release() noexcept {
  for (const auto& runner : runners_) runner->gate().Open();
  if (tracer_ != nullptr) {
    const Time ended = SteadyClock().Now();
    for (const auto& runner : runners_) tracer_->OnHold(runner->path(), began_, ended);
  }
  runners_.clear();
}

}  // namespace runnel

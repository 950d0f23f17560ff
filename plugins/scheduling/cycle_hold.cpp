#include "plugins/scheduling/cycle_hold.h"

#include <algorithm>
#include <chrono>

#include "core/base/check.h"
#include "core/lockfree/backoff.h"
#include "core/lockfree/thread_epoch.h"
#include "plugins/scheduling/cycle_runner.h"
#include "plugins/timing/trace_track.h"

namespace runnel {

namespace {
constexpr Duration kBrief = std::chrono::milliseconds(50);
}  // namespace

Result<CycleHold> CycleHold::Take(std::vector<std::shared_ptr<CycleRunner>> runners, Duration timeout,
                                  CycleTracer* tracer) {
  RUNNEL_CHECK(!EpochGuard::HeldByThisThread(), "threads cannot be kept between cycles from within a cycle");
  const SteadyClock clock;
  const Time deadline = SaturatingSum(clock.Now(), timeout);
  std::ranges::stable_sort(runners, std::ranges::greater{},
                           [](const auto& runner) { return runner->statistics().execution_mean; });
  CycleHold hold;
  hold.tracer_ = tracer;
  hold.began_ = clock.Now();
  hold.runners_.reserve(runners.size());  // whose gate is closed is known by the hold, whatever fails
  std::deque<std::shared_ptr<CycleRunner>> left(runners.begin(), runners.end());
  for (; !left.empty(); left.pop_front()) {
    left.front()->gate().Close();
    hold.runners_.push_back(left.front());
    const CycleRunner& closed = *left.front();
    // Passes a heavy fence; see CycleGate.
    const std::uint64_t epoch = ProcessEpochs().Advance();
    const Time closed_at = clock.Now();
    for (int round = 0; !closed.quiescence()->HasLeft(epoch); ++round) {
      const Time now = clock.Now();
      if (now > deadline) {
        return Error{.message = "has not come to the end of its cycle in " + std::to_string(ToSeconds(timeout)) + " s",
                     .path = closed.path(),
                     .hint = "one of its modules does not return from its Update()"};
      }
      if (now - closed_at > kBrief) hold.LetOthersGoOn(left, now - closed_at);
      BackOff(round);
    }
  }
  return hold;
}

// A drive does not stand still for as long as a planner takes this time. Those whose own cycles take as long stay, and
// longer each time that one of them was let go on: else each would be kept while the other one is not, for ever.
void CycleHold::LetOthersGoOn(std::deque<std::shared_ptr<CycleRunner>>& left, Duration waited) {
  for (auto each = runners_.begin(); each != runners_.end();) {
    const Duration usual = (*each)->statistics().execution_mean;
    if (*each == left.front() || usual >= std::max(kBrief, waited / patience_)) {
      ++each;
      continue;
    }
    if (usual >= kBrief) patience_ *= 2;
    left.push_back(*each);
    (*each)->gate().Open();
    each = runners_.erase(each);
  }
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

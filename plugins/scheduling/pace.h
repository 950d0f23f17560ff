#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <utility>

#include "core/base/clock.h"
#include "core/base/ordered_mutex.h"
#include "core/base/result.h"
#include "core/lockfree/wake_event.h"
#include "plugins/timing/pacing.h"

namespace runnel {

/// How fast simulated time passes, and whether it does, while the application runs. It only ever
/// delays cycles: what they compute does not depend on it.
///
/// Threads:  any, also within cycles, but for what is the scheduler's.
/// Errors:   all that changes anything fails on a real clock, which passes as it does.
class Pace {
 public:
  /// `machine` must outlive this. Precondition: Pacing::Takes(speed).
  /// `follows_outside`: simulated time passes as SetTime() says.
  Pace(bool is_simulated, double speed, bool is_paused, const Clock& machine, bool follows_outside = false);

  /// What the clock shows that this one follows: cycles that are due until then run, one after the other, at their times.
  /// The first time is where it begins. Where the clock jumps, back (a simulator begins anew, a recording is played again) or
  /// ahead by more than kLongestStep, time here goes on from where it is. Errors: it follows none.
  Result<void> SetTime(Time time);
  static constexpr Duration kLongestStep = std::chrono::seconds(10);
  /// By how much time here is ahead of what the clock shows, which has jumped.
  [[nodiscard]] Duration outside_lead() const noexcept {
    return Duration(outside_lead_.load(std::memory_order_acquire));
  }
  /// From where to where it has jumped since this was last asked; of jumps without a step between the first.
  [[nodiscard]] std::optional<std::pair<Time, Time>> TakeJump();
  [[nodiscard]] bool follows_outside() const noexcept { return follows_outside_; }
  /// By time here. Nothing before the first.
  [[nodiscard]] std::optional<Time> outside_time() const noexcept {
    const auto time = outside_time_.load(std::memory_order_acquire);
    return time == kNoTime ? std::nullopt : std::optional(Time(Duration(time)));
  }

  /// No further cycle begins; one that is under way comes to its end.
  Result<void> Pause();
  /// Goes on, and forgets cycles that were still to be stepped.
  Result<void> Resume();
  /// Pauses if it is not paused, and lets so many further cycles run, no faster than the speed allows:
  /// each the one that is due next, and what its data sets off (Scheduler::Step()). Adds up.
  /// Errors: not from 1 to kMostCycles.
  Result<void> StepCycles(std::uint64_t count = 1);
  /// At most so many times real time; 0: as fast as it can. Errors: not in Pacing's bounds.
  Result<void> SetSpeed(double speed);

  /// The run has ended: what would wait for further cycles is refused from now on, and what waits for some is over.
  void End();
  /// There is another run.
  void Begin();

  [[nodiscard]] bool is_simulated() const noexcept { return is_simulated_; }
  /// Also while cycles are stepped.
  /// After End(), until Begin(): nothing of it can be changed.
  [[nodiscard]] bool has_ended() const noexcept { return has_ended_.load(std::memory_order_acquire); }
  [[nodiscard]] bool is_paused() const noexcept { return is_paused_.load(std::memory_order_acquire); }
  /// That have been stepped for and have not come to their end yet.
  [[nodiscard]] std::uint64_t cycles_to_step() const noexcept {
    return cycles_to_step_.load(std::memory_order_acquire);
  }
  /// 1 on a real clock.
  [[nodiscard]] double speed() const noexcept { return speed_.load(std::memory_order_acquire); }

  static constexpr std::uint64_t kMostCycles = 1'000'000'000;

  /// Whether simulated time may go on to `due` now. Takes no lock while there is neither a pause nor
  /// a speed. By the scheduler, between cycles.
  [[nodiscard]] bool MayGoOnTo(Time due) { return is_free_.load(std::memory_order_acquire) || MayGoOnNow(due); }
  /// The cycle that MayGoOnTo() has allowed is over. By the scheduler.
  void CountCycle() noexcept {
    if (is_a_step_) CountStep();
  }
  /// After MayGoOnTo() has said no: sleeps until it may say yes, but not beyond `latest` of the
  /// machine's clock, nor longer than kLongestSleep. By the scheduler.
  void Wait(Time latest);

  static constexpr Duration kLongestSleep = std::chrono::milliseconds(100);

 private:
  [[nodiscard]] bool MayGoOnNow(Time due);
  void CountStep() noexcept;
  // Errors: a real clock; the run has ended.
  Result<void> Check(const char* what) const;
  // Under the mutex. Has the scheduler look again.
  void Changed();

  static constexpr Duration::rep kNoTime = Duration::min().count();

  const bool is_simulated_;
  const bool follows_outside_;
  std::atomic<Duration::rep> outside_time_{kNoTime};
  std::atomic<Duration::rep> outside_lead_{0};
  const Clock& machine_;
  OrderedMutex mutex_{LockLevel::kLeaf};
  Pacing pacing_;                              // guarded by mutex_
  Time shown_{};                               // by the clock that is followed; likewise
  bool has_jumped_ = false;                    // the last time; likewise
  std::optional<std::pair<Time, Time>> jump_;  // likewise
  // Written under mutex_:
  std::atomic<double> speed_;
  std::atomic<bool> is_paused_;
  std::atomic<std::uint64_t> cycles_to_step_{0};
  std::atomic<bool> is_free_;
  std::atomic<bool> has_ended_{false};
  WakeEvent event_;
  // The scheduler's own:
  bool is_a_step_ = false;
  Time may_go_on_at_{};
};

}  // namespace runnel

#pragma once

#include <algorithm>

#include "core/base/clock.h"

namespace runnel {

/// How a thread container runs its modules.
struct ThreadOptions {
  enum class Activation {
    kPeriod,       ///< once every `period`
    kFreeRunning,  ///< again as soon as it has ended
    kTrigger,      ///< a module runs when data has come to one of its trigger inputs, else not
  };
  /// What happens to the cycles that a cycle that took too long has used up.
  enum class OnOverrun {
    kSkip,     ///< left out: the next cycle begins at the next planned time
    kCatchUp,  ///< run one after the other, without a pause, until the plan is met again
  };

  Activation activation = Activation::kPeriod;
  /// kPeriod: from cycle to cycle. kFreeRunning: how long a cycle takes in simulated time, since
  /// there no time would pass otherwise; without meaning on the real clock.
  Duration period = std::chrono::milliseconds(10);
  int priority = 0;  ///< 0: ordinary scheduling; 1 .. 99: SCHED_FIFO with this priority
  OnOverrun on_overrun = OnOverrun::kSkip;
};

/// When the next cycle of a periodic thread is due. Due times are multiples of the period from the
/// first one, so that no error adds up; where a Time can hold no more, they end.
///
/// Precondition: period > 0. Threads: a value.
class DueTime {
 public:
  DueTime(Time first, Duration period, ThreadOptions::OnOverrun on_overrun) noexcept
      : next_(first), period_(period), on_overrun_(on_overrun) {}

  [[nodiscard]] Time next() const noexcept { return next_; }

  /// The cycle that was due has ended at `ended`: goes on to the next one. Returns true for an
  /// overrun, that is if the next one had been due before.
  bool Advance(Time ended) noexcept {
    next_ = SaturatingSum(next_, period_);
    if (ended <= next_) return false;
    if (on_overrun_ == ThreadOptions::OnOverrun::kSkip) {
      const auto missed_whole = (ended - next_ - Duration(1)) / period_;
      next_ = SaturatingSum(next_ + missed_whole * period_, period_);
    }
    return true;
  }

  [[nodiscard]] Duration period() const noexcept { return period_; }
  /// The next cycle is due no later than a new period after `now`.
  void Change(Duration period, ThreadOptions::OnOverrun on_overrun, Time now) noexcept {
    period_ = period;
    on_overrun_ = on_overrun;
    next_ = std::min(next_, SaturatingSum(now, period));
  }

 private:
  Time next_;
  Duration period_;
  ThreadOptions::OnOverrun on_overrun_;
};

}  // namespace runnel

#pragma once

#include <algorithm>

#include "core/base/clock.h"
#include "plugins/scheduling/thread_options.h"

namespace runnel {

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

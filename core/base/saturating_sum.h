#pragma once

#include "core/base/clock.h"

namespace runnel {

/// `time` plus a duration, or the last time that a Time can hold: users may write durations of
/// centuries. Precondition: duration >= 0.
[[nodiscard]] constexpr Time SaturatingSum(Time time, Duration duration) noexcept {
  // Times before the clock's start leave room for any duration.
  if (time > Time{} && duration > Time::max() - time) return Time::max();
  return time + duration;
}

}  // namespace runnel

#pragma once

#include "core/base/clock.h"
#include "core/lockfree/publication.h"

namespace runnel {

/// The two times of a published value, on the application's clock.
struct ValueTimes {
  Time timestamp{};         ///< when it was measured, if its publisher said so; else publication_time
  Time publication_time{};  ///< of the cycle that published it

  /// Of a value that its publisher gives no time of its own.
  [[nodiscard]] static ValueTimes Of(Time now) noexcept { return {now, now}; }
  [[nodiscard]] static ValueTimes Of(const Publication& publication) noexcept {
    return {Time(Duration(publication.timestamp)), Time(Duration(publication.publication_time))};
  }
  /// For who asks for one of them: the age of a value is counted from its measurement.
  operator Time() const noexcept { return timestamp; }
};

}  // namespace runnel

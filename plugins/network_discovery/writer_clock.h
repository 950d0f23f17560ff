#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

#include "core/base/clock.h"

namespace runnel {

/// What is known of another machine's clock by when values were sent there and came here: no delay is below 0, and none that
/// a network makes is large, so the smallest one of late tells how far the clocks are apart at least.
class WriterClock {
 public:
  /// `delay`: from sending to arrival, by the two clocks.
  void Note(Duration delay, Time now) {
    constexpr auto kWindow = std::chrono::seconds(5);  // so that a clock that is set is followed
    if (!least_) began_ = now;
    if (now - began_ > kWindow) {
      before_ = least_;
      least_.reset();
      began_ = now;
    }
    least_ = std::min(least_.value_or(delay), delay);
  }
  /// Of late.
  [[nodiscard]] std::optional<Duration> least() const {
    return before_ && least_ ? std::min(before_, least_) : least_;
  }
  /// By how much it is evidently behind; below 0: ahead; 0: neither. `may_be_old`: values may have been there long before
  /// they were sent.
  [[nodiscard]] Duration behind(bool may_be_old) const {
    const Duration delay = least().value_or(Duration{});
    return delay < Duration{} || (delay > kMostOfNetworks && !may_be_old) ? delay : Duration{};
  }
  /// More than a network takes.
  static constexpr Duration kMostOfNetworks = std::chrono::milliseconds(250);

 private:
  Time began_{};
  std::optional<Duration> before_ = {};
  std::optional<Duration> least_ = {};
};

}  // namespace runnel

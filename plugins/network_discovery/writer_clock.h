#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

#include "core/base/clock.h"

namespace runnel {

/// What is known of another machine's clock by when values were measured there and came here: no delay is below 0, so the
/// smallest one of late tells how far that clock is ahead at least. A clock that is behind cannot be told from values that are
/// held up.
class WriterClock {
 public:
  /// `delay`: from measuring to arrival, by the two clocks.
  void Note(Duration delay, Time now) {
    constexpr auto kWindow = std::chrono::minutes(1);  // so that a clock that is set is followed
    if (!least_) began_ = now;
    if (now - began_ > kWindow) {
      before_ = least_;
      least_.reset();
      began_ = now;
    }
    least_ = std::min(least_.value_or(delay), delay);
  }
  /// By how much longer a value was under way than others, if more than a network takes: it was held up, and is no news,
  /// however many come so. Only if the delay jumps from one value to the next, which came soon after, has the clock been
  /// set. After Note().
  [[nodiscard]] Duration HeldUp(Duration delay, Time now, Duration longest = kLongestDelay) {
    constexpr int kDrift = 1000;  // of two clocks, one of which may be slewed; one part in so many
    const Duration gap = now - came_;
    const bool is_set = usual_ && delay - last_ > kMostOfNetworks && gap < (delay - last_) / 2;
    const bool is_new = is_set || !usual_;
    // Of a burst of what was held up, each took less time than the one before, but for pauses in it: only what comes later
    // tells what is usual.
    const bool is_burst = least_since_ - delay > kFall || delay - last_ > std::max<Duration>(gap / 2, kRise);
    if (is_new || (!is_known_ && is_burst)) {
      known_from_ = now + kToKnow;
      least_since_ = is_new ? delay : std::min(least_since_, delay);
    }
    is_known_ = !is_new && (is_known_ || now >= known_from_);
    const Duration least = is_known_ ? *usual_ : delay > longest ? delay : Duration{};
    sent_ = std::max(Time(), now - BeyondNetworks(delay - least));
    usual_ = is_new ? delay : std::min(*usual_ + gap / kDrift, delay);
    last_ = delay;
    came_ = now;
    return BeyondNetworks(delay - *usual_);
  }
  /// When what came last was sent at the earliest, by the clock of `now`: to be compared with the STOP. While too little has
  /// come for it to be known what is usual, both clocks are believed, if they are no further apart than `longest`: nothing
  /// from before a STOP is taken for new for want of knowledge. If the clock is merely behind, it is to be asked for again.
  [[nodiscard]] Time sent() const { return sent_; }
  /// Of late.
  [[nodiscard]] std::optional<Duration> least() const { return before_ && least_ ? std::min(before_, least_) : least_; }
  /// By how much it is evidently ahead; 0: not so.
  [[nodiscard]] Duration ahead() const { return std::max(Duration{}, -least().value_or(Duration{})); }
  /// More than a network takes.
  static constexpr Duration kMostOfNetworks = std::chrono::milliseconds(250);
  /// More is the difference of two clocks.
  static constexpr Duration kLongestDelay = std::chrono::minutes(1);

  /// After so long without a sign of a burst it is known what is usual.
  static constexpr Duration kToKnow = std::chrono::seconds(1);

 private:
  static constexpr Duration kFall = std::chrono::milliseconds(10), kRise = std::chrono::milliseconds(50);
  [[nodiscard]] static Duration BeyondNetworks(Duration delay) { return delay > kMostOfNetworks ? delay : Duration{}; }

  Time began_{};
  std::optional<Duration> before_ = {};
  std::optional<Duration> least_ = {};
  std::optional<Duration> usual_ = {};
  Duration last_{};
  Time came_{};
  Time sent_{};
  bool is_known_ = false;  // what is usual
  Time known_from_{};
  Duration least_since_{};  // the least delay when that wait began
};

}  // namespace runnel

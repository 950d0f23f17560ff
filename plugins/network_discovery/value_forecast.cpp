#include "plugins/network_discovery/value_forecast.h"

#include <algorithm>
#include <chrono>

namespace runnel {

namespace {

using std::chrono::microseconds;

constexpr Duration kLeastHalf = microseconds(8);        // of a window
constexpr Duration kMostHalf = microseconds(60);        // beyond, more would be spent than gained
constexpr Duration kShortest = microseconds(500);       // of intervals: below, the thread hardly sleeps
constexpr Duration kLongest = std::chrono::seconds(1);  // clocks and threads drift
constexpr int kEnough = 16;

}  // namespace

void ValueForecast::BeginAnew(Time came) {
  interval_ = came - last_;
  last_ = came;
  expected_ = came + interval_;
  deviation_ = {};
  even_ = 0;
}

// Who publishes by a clock comes now sooner, now later than it means to; the mean is what is followed.
void ValueForecast::Note(Time came) {
  const Duration early = expected_ - came;
  const Duration difference = early < Duration{} ? -early : early;
  if (difference > interval_ / 4) return BeginAnew(came);
  even_ = std::min(even_ + 1, kEnough);
  const Duration most = 2 * deviation_ + kLeastHalf;  // one that is very late says nothing of the next
  const Duration step = std::clamp(early, -most, most);
  interval_ -= step / 64;
  expected_ += interval_ - step / 8;
  deviation_ += (std::min(difference, kMostHalf) - deviation_) / 16;
  last_ = came;
}

std::optional<ValueForecast::Window> ValueForecast::window(Time now) const {
  if (even_ < kEnough || interval_ < kShortest || interval_ > kLongest) return {};
  if (deviation_ > kMostHalf * 3 / 4) return {};
  const Duration half = std::clamp(2 * deviation_, kLeastHalf, std::min(kMostHalf, interval_ / 16));
  const Window window{expected_ - half, expected_ + half};
  return now < window.end ? std::optional(window) : std::nullopt;
}

}  // namespace runnel

#include "core/base/clock.h"

#include <time.h>

namespace runnel {

Time SteadyClock::Now() const noexcept {
  return Time(std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now().time_since_epoch()));
}

Time SteadyClock::CoarseNow(Time event) const noexcept {
  // The same time line as std::chrono::steady_clock, which is CLOCK_MONOTONIC.
  timespec tick{};
  clock_gettime(CLOCK_MONOTONIC_COARSE, &tick);
  const Time now(std::chrono::seconds(tick.tv_sec) + std::chrono::nanoseconds(tick.tv_nsec));
  // What is further ahead has not happened yet.
  constexpr Duration kLongestTick = std::chrono::milliseconds(10);
  return event > now && event - now <= kLongestTick ? event : now;
}

void ManualClock::Set(Time time) noexcept {
  if (time <= Now()) return;
  now_.store(time.time_since_epoch().count(), std::memory_order_release);
}

}  // namespace runnel

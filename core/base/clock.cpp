#include "core/base/clock.h"

namespace runnel {

Time SteadyClock::Now() const noexcept {
  return Time(
      std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now().time_since_epoch()));
}

void ManualClock::Set(Time time) noexcept {
  if (time <= Now()) return;
  now_.store(time.time_since_epoch().count(), std::memory_order_release);
}

}  // namespace runnel

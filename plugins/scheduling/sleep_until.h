#pragma once

#include <algorithm>
#include <chrono>

#include <time.h>

#include "core/base/clock.h"

namespace runnel {

/// Sleeps until the steady clock shows `due`, at once if it does already. Wakes a few times a
/// second to ask `give_up()`. Returns false if given up.
template <typename GiveUp>
bool SleepUntil(Time due, const GiveUp& give_up) {
  constexpr Duration kLongestSleep = std::chrono::milliseconds(100);
  const SteadyClock clock;
  for (Time now = clock.Now(); now < due; now = clock.Now()) {
    if (give_up()) return false;
    const auto until = std::min(due, now + kLongestSleep).time_since_epoch();
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(until);
    timespec wake{};
    wake.tv_sec = static_cast<time_t>(seconds.count());
    wake.tv_nsec = static_cast<long>((until - seconds).count());
    // The steady clock is CLOCK_MONOTONIC. A signal that ends the sleep early does no harm.
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake, nullptr);
  }
  return !give_up();
}

}  // namespace runnel

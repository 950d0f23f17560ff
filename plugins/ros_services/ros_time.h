#pragma once

#include <chrono>
#include <functional>

#include "core/base/clock.h"

namespace runnel {

/// As stamps of messages count: since the begin of 1970, by the system's clock.
[[nodiscard]] inline Time SinceEpoch() {
  return Time(std::chrono::duration_cast<Duration>(std::chrono::system_clock::now().time_since_epoch()));
}

/// From a clock of this application to the time since 1970 and back. Simulated time is kept as it is, but where it follows
/// a clock that has jumped: then stamps are by that.
struct ClockOffset {
  bool is_simulated = false;
  std::function<Duration()> lead = {};  ///< of simulated time before the clock that it follows; any thread
  /// Now; the two clocks may drift.
  [[nodiscard]] Duration Now() const {
    if (is_simulated) return lead ? -lead() : Duration{};
    return SinceEpoch() - SteadyClock().Now();
  }
};

}  // namespace runnel

#pragma once

#include <chrono>

#include "core/base/clock.h"

namespace runnel {

/// As stamps of messages count: since the begin of 1970, by the system's clock.
[[nodiscard]] inline Time SinceEpoch() {
  return Time(std::chrono::duration_cast<Duration>(std::chrono::system_clock::now().time_since_epoch()));
}

}  // namespace runnel

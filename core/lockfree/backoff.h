#pragma once

#include <chrono>
#include <thread>

namespace runnel {

/// Backs off: one round of waiting for another thread, outside of cycles: yields in the first rounds, in which
/// most waits end, then sleeps for 50 us each.
inline void BackOff(int round) {
  if (round < 64) {
    std::this_thread::yield();
  } else {
    std::this_thread::sleep_for(std::chrono::microseconds(50));
  }
}

}  // namespace runnel

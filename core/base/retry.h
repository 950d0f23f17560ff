#pragma once

#include <chrono>
#include <thread>

namespace runnel {

/// Calls `action` again, a millisecond later each time, while it throws, but not without end. For what takes
/// something back: there is nobody to tell, and memory that was short a moment ago may be there now. Whether it
/// has come to its end at last. `action` finds what an earlier call of it has done already.
template <typename Action>
bool Retry(Action&& action) noexcept {
  constexpr int kAttempts = 1000;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    try {
      action();
      return true;
    } catch (...) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  return false;
}

}  // namespace runnel

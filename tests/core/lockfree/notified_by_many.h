#pragma once

#include <atomic>
#include <chrono>

#include <gtest/gtest.h>

#include "core/lockfree/futex.h"
#include "tests/support/threads.h"

namespace runnel::test {

/// Only against hanging for ever: a lost wake-up shows as a wait that ran out of this time.
inline KernelFutex::Deadline Late() { return std::chrono::steady_clock::now() + std::chrono::seconds(30); }

/// Three threads put things somewhere and notify `event`, all at once; one waits until it has seen all.
/// `wait(put, seen)` waits for more than `seen` and says whether it came.
template <typename Event, typename Wait>
void NotifyByMany(Event& event, const Wait& wait) {
  constexpr int kEach = 3000;
  std::atomic<int> put{0};
  RunTogether(4, [&](unsigned index) {
    if (index > 0) {
      for (int i = 0; i < kEach; ++i) {
        put.fetch_add(1, std::memory_order_relaxed);
        event.Notify();
      }
      return;
    }
    for (int seen = 0; seen < 3 * kEach;) {
      ASSERT_TRUE(wait(put, seen));
      seen = put.load(std::memory_order_relaxed);
    }
  });
}

}  // namespace runnel::test

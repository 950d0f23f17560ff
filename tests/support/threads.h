#pragma once

#include <atomic>
#include <functional>
#include <thread>
#include <vector>

#include "tests/support/yielding_atomic.h"

namespace runnel::test {

/// Runs `body(index)` in `count` threads, which begin together, and waits for all to end. Each has
/// its own seed for YieldingAtomic.
inline void RunTogether(unsigned count, const std::function<void(unsigned)>& body) {
  std::atomic<unsigned> waiting{count};
  std::vector<std::thread> threads;
  for (unsigned index = 0; index < count; ++index) {
    threads.emplace_back([&, index] {
      SeedYields(index + 1);
      --waiting;
      while (waiting > 0) std::this_thread::yield();
      body(index);
    });
  }
  for (std::thread& thread : threads) thread.join();
}

}  // namespace runnel::test

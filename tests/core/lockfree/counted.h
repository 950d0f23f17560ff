#pragma once

#include <atomic>
#include <cstdint>

namespace runnel::test {

/// Counts how many of it there are.
struct Counted {
  Counted() { ++alive(); }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;
  ~Counted() { --alive(); }
  static std::atomic<int>& alive() {
    static std::atomic<int> count{0};
    return count;
  }
  std::uint64_t number = 0;
};

}  // namespace runnel::test

#pragma once

#include <atomic>
#include <cstdint>
#include <thread>

namespace runnel::test {

/// What decides, for the calling thread, where YieldingAtomic yields. Seeded anew for each thread
/// of a test, it draws the same decisions in each run; what the machine's scheduler makes of them
/// may still differ.
inline std::uint64_t& YieldState() noexcept {
  thread_local constinit std::uint64_t state = 1;
  return state;
}
/// Precondition: any seed; 0 counts as 1.
inline void SeedYields(std::uint64_t seed) noexcept { YieldState() = (seed != 0 ? seed : 1) * 0x9E3779B97F4A7C15u; }
inline void MaybeYield() noexcept {
  std::uint64_t& state = YieldState();  // xorshift64 (Marsaglia 2003)
  state ^= state << 13;
  state ^= state >> 7;
  state ^= state << 17;
  if ((state >> 32) % 4 == 0) std::this_thread::yield();
}

/// Stands in for std::atomic in the lock-free templates: gives other threads a chance to come
/// between any two operations, which they would rarely get on an idle machine.
template <typename T>
class YieldingAtomic {
 public:
  YieldingAtomic() noexcept : YieldingAtomic(T{}) {}
  YieldingAtomic(T value) noexcept : atomic_(value) {}

  T load(std::memory_order order) const noexcept {
    return Between([&] { return atomic_.load(order); });
  }
  void store(T value, std::memory_order order) noexcept {
    MaybeYield();
    atomic_.store(value, order);
    MaybeYield();
  }
  T exchange(T value, std::memory_order order) noexcept {
    return Between([&] { return atomic_.exchange(value, order); });
  }
  T fetch_add(T value, std::memory_order order) noexcept {
    return Between([&] { return atomic_.fetch_add(value, order); });
  }
  T fetch_sub(T value, std::memory_order order) noexcept {
    return Between([&] { return atomic_.fetch_sub(value, order); });
  }
  T fetch_or(T value, std::memory_order order) noexcept {
    return Between([&] { return atomic_.fetch_or(value, order); });
  }
  bool compare_exchange_weak(T& expected, T desired, std::memory_order success, std::memory_order failure) noexcept {
    return Between([&] { return atomic_.compare_exchange_weak(expected, desired, success, failure); });
  }
  bool compare_exchange_strong(T& expected, T desired, std::memory_order success, std::memory_order failure) noexcept {
    return Between([&] { return atomic_.compare_exchange_strong(expected, desired, success, failure); });
  }

 private:
  template <typename Operation>
  static auto Between(Operation&& operation) noexcept {
    MaybeYield();
    const auto result = operation();
    MaybeYield();
    return result;
  }

  std::atomic<T> atomic_;
};

}  // namespace runnel::test

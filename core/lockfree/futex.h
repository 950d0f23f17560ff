#pragma once

#include <chrono>
#include <cstdint>

namespace runnel {

/// The kernel's side of a thread that sleeps on a 32-bit word (futex). A type of its own, so that
/// tests can put another kernel below what uses it.
///
/// Threads: any, of one process. Source: U. Drepper, "Futexes are tricky" (2011).
struct KernelFutex {
  using Deadline = std::chrono::steady_clock::time_point;  ///< on CLOCK_MONOTONIC
  static constexpr Deadline kNever = Deadline::max();
  using Waiters = std::uint32_t;  ///< a set of those who sleep on one word, who say which they are
  static constexpr Waiters kAll = ~Waiters{0};

  /// Sleeps as `waiter` if `word` is still `expected`, until it is woken, or until the deadline; may
  /// also return for no reason. False if the deadline has passed.
  template <typename Word>
  static bool Sleep(Word& word, std::uint32_t expected, Deadline deadline, Waiters waiter = kAll) noexcept {
    static_assert(sizeof(Word) == sizeof(std::uint32_t));
    return SleepOn(&word, expected, deadline, waiter);
  }
  /// Wakes those of `waiters` who sleep on `word`; a system call.
  template <typename Word>
  static void Wake(Word& word, Waiters waiters = kAll) noexcept {
    static_assert(sizeof(Word) == sizeof(std::uint32_t));
    WakeOn(&word, waiters);
  }

 private:
  static bool SleepOn(const void* word, std::uint32_t expected, Deadline deadline, Waiters waiter) noexcept;
  static void WakeOn(const void* word, Waiters waiters) noexcept;
};

}  // namespace runnel

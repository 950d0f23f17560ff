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
  using Sleepers = std::uint32_t;  ///< a set of those who sleep on one word, who say which they are
  static constexpr Sleepers kAll = ~Sleepers{0};

  /// Sleeps as `sleeper` if `word` is still `expected`, until it is woken, or until the deadline; may
  /// also return for no reason. False if the deadline has passed.
  template <typename Word>
  static bool Sleep(Word& word, std::uint32_t expected, Deadline deadline,
                    Sleepers sleeper = kAll) noexcept {
    static_assert(sizeof(Word) == sizeof(std::uint32_t));
    return SleepOn(&word, expected, deadline, sleeper);
  }
  /// Wakes those of `sleepers` who sleep on `word`; a system call.
  template <typename Word>
  static void Wake(Word& word, Sleepers sleepers = kAll) noexcept {
    static_assert(sizeof(Word) == sizeof(std::uint32_t));
    WakeOn(&word, sleepers);
  }

 private:
  static bool SleepOn(const void* word, std::uint32_t expected, Deadline deadline,
                      Sleepers sleeper) noexcept;
  static void WakeOn(const void* word, Sleepers sleepers) noexcept;
};

}  // namespace runnel

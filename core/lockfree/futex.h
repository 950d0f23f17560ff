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

  /// Sleeps if `word` is still `expected`, until Wake(), or until the deadline; may also return
  /// for no reason. False if the deadline has passed.
  template <typename Word>
  static bool Sleep(Word& word, std::uint32_t expected, Deadline deadline) noexcept {
    static_assert(sizeof(Word) == sizeof(std::uint32_t));
    return SleepOn(&word, expected, deadline);
  }
  /// Wakes who sleeps on `word`; a system call.
  template <typename Word>
  static void Wake(Word& word) noexcept {
    static_assert(sizeof(Word) == sizeof(std::uint32_t));
    WakeOn(&word);
  }

 private:
  static bool SleepOn(const void* word, std::uint32_t expected, Deadline deadline) noexcept;
  static void WakeOn(const void* word) noexcept;
};

}  // namespace runnel

#pragma once

// The kernel's side of sleeping, for the search. searched_atomic.h must have been included before.

#include <cstdint>

namespace runnel::test {

/// A kernel with one word to sleep on. Comparing it and going to sleep are one step, as they are under the
/// lock of a real one: the search lets others come only before an operation on an atomic. A wake
/// that is lost leaves the thread asleep for ever, which ends as "too deep".
struct SearchedFutex {
  using Deadline = int;
  enum : int { kNever, kAtOnce };  // a deadline that has passed already
  using Waiters = std::uint32_t;
  static constexpr Waiters kAll = ~Waiters{0};
  inline static Waiters asleep = 0;
  inline static int wakes = 0;

  static void Reset() { asleep = wakes = 0; }
  static bool Sleep(SearchedAtomic<std::uint32_t>& word, std::uint32_t expected, Deadline deadline,
                    Waiters waiter = 1) {
    if (word.fetch_add(0, std::memory_order_seq_cst) != expected) return true;
    if (deadline == kAtOnce) return false;
    asleep |= waiter;
    while ((asleep & waiter) != 0) rl::yield(1, $);
    return true;
  }
  static void Wake(SearchedAtomic<std::uint32_t>&, Waiters waiters = kAll) {
    asleep &= ~waiters;
    ++wakes;
  }
};

}  // namespace runnel::test

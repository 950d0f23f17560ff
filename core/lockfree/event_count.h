#pragma once

#include <atomic>
#include <cstdint>

#include "core/lockfree/cache_line.h"
#include "core/lockfree/futex.h"

namespace runnel {

/// What up to 32 threads sleep on, each under a bit of its own, so that one call of the system wakes any
/// number of them.
///
/// Threads:     any. Progress: Notify() is wait-free, and calls the system. Allocation: none.
/// Limits:      a waiter that is held up between two looks while the count comes round to the same
///              number, 2^32 notifications later, misses the last one.
/// @tparam Atomic, Futex  replaced in tests.
template <template <typename> class Atomic = std::atomic, typename Futex = KernelFutex>
class EventCount {
 public:
  using Deadline = typename Futex::Deadline;
  using Waiters = typename Futex::Waiters;  ///< a bit for each

  /// Wakes those of `waiters` who sleep. Call it after what they look for is there.
  void Notify(Waiters waiters) noexcept {
    // release: pairs with the acquire in SleepWhile(): who reads the new count sees what there is.
    count_.fetch_add(1, std::memory_order_release);
    Futex::Wake(count_, waiters);
  }

  /// Sleeps under `waiter_bit` as long as `is_asleep()`; false if the deadline has passed before. Notify() for
  /// other waiters may make it look once more than it need.
  template <typename IsAsleep>
  bool SleepWhile(Waiters waiter_bit, Deadline deadline, const IsAsleep& is_asleep) noexcept {
    for (;;) {
      // acquire: as above. So the count comes before the look, and the kernel compares it again under
      // a lock that waking takes too: no notification in between is slept through.
      const std::uint32_t count = count_.load(std::memory_order_acquire);
      if (!is_asleep()) return true;
      if (!Futex::Sleep(count_, count, deadline, waiter_bit)) return false;
    }
  }

 private:
  alignas(kCacheLineSize) Atomic<std::uint32_t> count_{0};
};

/// One thread that sleeps on an event count until there is something for it. Notifications that come before it
/// looks add up to one.
///
///     notifier:  put it there ─ MarkNotified() ─ (only if it was asleep) EventCount::Notify()
///     waiter:    mark itself asleep ─ read the count ─ not notified? ─ sleep while the count is that
///
/// All that changes the word are read-modify-writes, so of "asleep" and "notified" one comes first: if
/// "notified", the waiter finds it; if "asleep", the notifier does, and wakes it.
///
/// Threads:     MarkNotified() by any; Wait() by one at a time.
/// Progress:    MarkNotified() is wait-free, without a system call. Wait() blocks.
/// Allocation:  none. Lifetime: the event count must outlive the last Notify() for this waiter, which may come
///              after Wait() has returned.
template <template <typename> class Atomic = std::atomic, typename Futex = KernelFutex>
class Waiter {
 public:
  using EventCount = runnel::EventCount<Atomic, Futex>;

  Waiter(EventCount& event_count, typename EventCount::Waiters waiter_bit) noexcept
      : event_count_(event_count), bit_(waiter_bit) {}

  /// There is something for it. Returns whether it sleeps: then the caller, and nobody else, has to call
  /// EventCount::Notify().
  [[nodiscard]] bool MarkNotified() noexcept {
    // release: pairs with the acquire at the end of Wait(); what was put there is visible, also by
    // notifiers that came before another, since each reads what the one before has written.
    return word_.exchange(kNotified, std::memory_order_release) == kAsleep;
  }

  /// MarkNotified(), and wakes it if it sleeps.
  void Notify() noexcept {
    if (MarkNotified()) event_count_.Notify(bit_);
  }

  /// Sleeps until it is notified, or until the deadline; returns whether it has been, and forgets it.
  bool Wait(typename EventCount::Deadline deadline) noexcept {
    std::uint32_t awake = kAwake;
    // relaxed, both: it hands nothing over; who exchanges the word later reads it.
    if (word_.compare_exchange_strong(awake, kAsleep, std::memory_order_relaxed, std::memory_order_relaxed)) {
      // relaxed: the count orders.
      event_count_.SleepWhile(bit_, deadline, [this] { return word_.load(std::memory_order_relaxed) == kAsleep; });
    }
    // acquire: as above.
    return word_.exchange(kAwake, std::memory_order_acquire) == kNotified;
  }

  [[nodiscard]] EventCount& event_count() const noexcept { return event_count_; }
  [[nodiscard]] typename EventCount::Waiters waiter_bit() const noexcept { return bit_; }

 private:
  static constexpr std::uint32_t kAwake = 0;
  static constexpr std::uint32_t kAsleep = 1;
  static constexpr std::uint32_t kNotified = 2;

  EventCount& event_count_;
  const typename EventCount::Waiters bit_;
  Atomic<std::uint32_t> word_{kAwake};
};

}  // namespace runnel

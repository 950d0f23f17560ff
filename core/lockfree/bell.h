#pragma once

#include <atomic>
#include <cstdint>

#include "core/lockfree/cache_line.h"
#include "core/lockfree/futex.h"

namespace runnel {

/// What up to 32 threads sleep on, each in a seat of its own, so that one call of the system wakes any
/// number of them.
///
/// Threads:     any. Progress: Ring() is wait-free, and calls the system. Allocation: none.
/// Limits:      a sleeper that is held up between two looks while the count of rings comes round to
///              the same number, 2^32 later, misses the last one.
/// @tparam Atomic, Futex  replaced in tests.
template <template <typename> class Atomic = std::atomic, typename Futex = KernelFutex>
class Bell {
 public:
  using Deadline = typename Futex::Deadline;
  using Seats = typename Futex::Sleepers;  ///< a bit for each

  /// Wakes who sleeps in one of `seats`. Call it after what they look for is there.
  void Ring(Seats seats) noexcept {
    // release: pairs with the acquire in SleepWhile(): who reads the new count sees what there is.
    rings_.fetch_add(1, std::memory_order_release);
    Futex::Wake(rings_, seats);
  }

  /// Sleeps in `seat` as long as `is_asleep()`; false if the deadline has passed before. A ring for other
  /// seats may make it look once more than it need.
  template <typename IsAsleep>
  bool SleepWhile(Seats seat, Deadline deadline, const IsAsleep& is_asleep) noexcept {
    for (;;) {
      // acquire: as above. So the count comes before the look, and the kernel compares it again under
      // a lock that waking takes too: a ring in between is not slept through.
      const std::uint32_t rings = rings_.load(std::memory_order_acquire);
      if (!is_asleep()) return true;
      if (!Futex::Sleep(rings_, rings, deadline, seat)) return false;
    }
  }

 private:
  alignas(kCacheLineSize) Atomic<std::uint32_t> rings_{0};
};

/// One who sleeps on a bell until there is something for it. Notices that come before it looks add up to
/// one.
///
///     notifier:  put it there ─ Notice() ─ (only if it was asleep) Bell::Ring()
///     sleeper:   say that it sleeps ─ read the bell's count ─ not noticed? ─ sleep while the count is that
///
/// All that changes the word are read-modify-writes, so of "asleep" and "noticed" one comes first: if
/// "noticed", the sleeper finds it; if "asleep", the notifier does, and rings.
///
/// Threads:     Notice() by any; Wait() by one at a time.
/// Progress:    Notice() is wait-free, without a system call. Wait() blocks.
/// Allocation:  none. Lifetime: the bell must outlive the last Ring() for this sleeper, which may come
///              after Wait() has returned.
template <template <typename> class Atomic = std::atomic, typename Futex = KernelFutex>
class Sleeper {
 public:
  using Bell = runnel::Bell<Atomic, Futex>;

  Sleeper(Bell& bell, typename Bell::Seats seat) noexcept : bell_(bell), seat_(seat) {}

  /// There is something for it. Returns whether it sleeps: then the caller, and nobody else, has to ring.
  [[nodiscard]] bool Notice() noexcept {
    // release: pairs with the acquire at the end of Wait(); what was put there is visible, also by
    // notifiers that came before another, since each reads what the one before has written.
    return word_.exchange(kNoticed, std::memory_order_release) == kAsleep;
  }

  /// Gives notice, and rings if it has to.
  void Notify() noexcept {
    if (Notice()) bell_.Ring(seat_);
  }

  /// Sleeps until there is a notice, or until the deadline; returns whether there is one, and takes it.
  bool Wait(typename Bell::Deadline deadline) noexcept {
    std::uint32_t awake = kAwake;
    // relaxed, both: it hands nothing over; who exchanges the word later reads it.
    if (word_.compare_exchange_strong(awake, kAsleep, std::memory_order_relaxed,
                                      std::memory_order_relaxed)) {
      // relaxed: the bell's count orders.
      bell_.SleepWhile(seat_, deadline,
                       [this] { return word_.load(std::memory_order_relaxed) == kAsleep; });
    }
    // acquire: as above.
    return word_.exchange(kAwake, std::memory_order_acquire) == kNoticed;
  }

  [[nodiscard]] Bell& bell() const noexcept { return bell_; }
  [[nodiscard]] typename Bell::Seats seat() const noexcept { return seat_; }

 private:
  static constexpr std::uint32_t kAwake = 0;
  static constexpr std::uint32_t kAsleep = 1;
  static constexpr std::uint32_t kNoticed = 2;

  Bell& bell_;
  const typename Bell::Seats seat_;
  Atomic<std::uint32_t> word_{kAwake};
};

}  // namespace runnel

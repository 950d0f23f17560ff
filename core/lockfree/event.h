#pragma once

#include <atomic>
#include <cstdint>

#include "core/lockfree/asymmetric_fence.h"
#include "core/lockfree/cache_line.h"
#include "core/lockfree/futex.h"

namespace runnel {

/// Lets one thread sleep until something has come that others put somewhere else: a value, an entry
/// of a queue. The event itself carries nothing; whoever wakes looks for himself.
///
///     others:  put it there ─ LightFence ─ look whether one sleeps ─ (only then) wake it
///     waiter:  say that it sleeps ─ HeavyFence ─ look whether it is there ─ (only if not) sleep
///
/// So of the two at least one sees the other: either the notifier finds the announcement, or the
/// waiter what has been put there. And if the notifier takes the announcement back before the
/// waiter is asleep, the kernel refuses to let it sleep, since it compares the word under a lock
/// that waking takes too.
///
/// Who takes the announcement back wakes; the others that come meanwhile need not: the waiter looks
/// again before it sleeps again, and announces itself anew for that, with the same fence.
///
/// Threads:     Notify() by any thread; Wait() by one at a time.
/// Progress:    Notify() is wait-free: one load if nobody sleeps, a system call for the first who
///              comes while one does. Wait() blocks, and calls the system each time it announces
///              itself.
/// Allocation:  none.
/// @tparam Atomic, Futex  replaced in tests.
template <template <typename> class Atomic = std::atomic, typename Futex = KernelFutex>
class Event {
 public:
  using Deadline = typename Futex::Deadline;

  /// Call it after what the waiter looks for is there.
  void Notify() noexcept {
    // Between what has been put there and the look for a waiter; pairs with Wait().
    Fences<Atomic>::Light();
    // relaxed, both: the fences order.
    if (asleep_.load(std::memory_order_relaxed) == kAwake) [[likely]]
      return;
    Wake();
  }

  /// Sleeps until `is_there()`, or until the deadline; says whether it is there. `is_there` is called
  /// a few times, and must find all that was put there before a Notify() that it can see.
  template <typename IsThere>
  [[nodiscard]] bool Wait(Deadline deadline, IsThere&& is_there) {
    if (is_there()) return true;
    for (;;) {
      const Announcement announcement(asleep_);
      // Between the announcement and the look; pairs with Notify().
      Fences<Atomic>::Heavy();
      if (is_there()) return true;
      // However it returns, for a reason or for none: look, and announce it anew before sleeping.
      if (!Futex::Sleep(asleep_, kAsleep, deadline)) return is_there();
    }
  }

 private:
  static constexpr std::uint32_t kAwake = 0;
  static constexpr std::uint32_t kAsleep = 1;

  // Taken back in any case, so that a notifier does not call the system for nobody.
  class Announcement {
   public:
    explicit Announcement(Atomic<std::uint32_t>& asleep) noexcept : asleep_(asleep) {
      asleep_.store(kAsleep, std::memory_order_relaxed);
    }
    ~Announcement() { asleep_.store(kAwake, std::memory_order_relaxed); }
    Announcement(const Announcement&) = delete;
    Announcement& operator=(const Announcement&) = delete;

   private:
    Atomic<std::uint32_t>& asleep_;
  };

  [[gnu::noinline]] void Wake() noexcept {
    // relaxed: only who takes the announcement back counts; the fences order.
    if (asleep_.exchange(kAwake, std::memory_order_relaxed) == kAsleep) Futex::Wake(asleep_);
  }

  alignas(kCacheLineSize) Atomic<std::uint32_t> asleep_{kAwake};
};

}  // namespace runnel

#pragma once

#include <atomic>
#include <cstdint>

#include "core/lockfree/asymmetric_fence.h"
#include "core/lockfree/cache_line.h"

namespace runnel {

/// Lets threads read shared structures without a lock while others replace parts of them: a part
/// that has been taken out is destroyed only when its grace period is over: when no reader can still look
/// at it.
///
///     reader:  Enter ─ load pointer ─ use what it points to ─ Leave
///     writer:  swap pointer ─ epoch = Advance() ─ … until HasPassed(epoch) … ─ delete the old part
///
/// A reader says that it is inside, passes a light fence, and loads the pointer; a writer swaps the
/// pointer, passes a heavy fence, and looks who is inside. So if HasPassed() sees a reader outside,
/// that reader's next Enter comes after the swap, and its loads find the new pointer. Pointers that
/// readers load are loaded with acquire and swapped with release.
///
/// Threads:     a Participant belongs to one thread; the rest may be called from any thread.
/// Progress:    Enter and Leave are wait-free: plain stores to the thread's own line. Advance()
///              passes a heavy fence, so it is nothing for a cycle.
/// Allocation:  none. The domain never frees participants; it is told of them by Add().
/// @tparam Atomic  replaced in tests.
template <template <typename> class Atomic = std::atomic>
class EpochDomain {
 public:
  /// One thread's part. Entries do not nest: EpochGuard counts them.
  struct alignas(kCacheLineSize) Participant {
    Atomic<std::uint64_t> entered{kOutside};
    Participant* next = nullptr;  // written before the participant is added, then constant
  };

  /// Makes the domain look at `participant` for ever after.
  void Add(Participant& participant) noexcept {
    Participant* head = participants_.load(std::memory_order_relaxed);
    do {
      participant.next = head;
      // release: pairs with the acquire in first(); the participant is complete. That a writer does
      // not miss it is seen to by the fence in Enter(), as for `entered`.
    } while (
        !participants_.compare_exchange_weak(head, &participant, std::memory_order_release, std::memory_order_relaxed));
  }

  void Enter(Participant& participant) noexcept {
    // acquire: pairs with the release in Advance(): who enters in a new epoch finds the new
    // pointer. release: who sees that this thread has entered anew sees as done what it did before
    // it left the last time. The fence stands between this store and the load of the pointer.
    participant.entered.store(epoch_.load(std::memory_order_acquire), std::memory_order_release);
    Fences<Atomic>::Light();
  }
  void Leave(Participant& participant) noexcept {
    // release: what the reader did with the old parts is done before a writer sees it outside.
    participant.entered.store(kOutside, std::memory_order_release);
  }

  /// Starts a new epoch, after a part has been taken out, and returns it.
  [[nodiscard]] std::uint64_t Advance() noexcept {
    // release: pairs with the acquire in Enter().
    const std::uint64_t epoch = epoch_.fetch_add(1, std::memory_order_release) + 1;
    // Between the swap, which the caller has done, and looking who is inside; pairs with Enter().
    Fences<Atomic>::Heavy();
    return epoch;
  }

  /// True once this reader, if it might have seen the state before `epoch`, has left.
  [[nodiscard]] static bool HasPassed(const Participant& participant, std::uint64_t epoch) noexcept {
    // acquire: pairs with the releases in Leave() and Enter().
    const std::uint64_t entered = participant.entered.load(std::memory_order_acquire);
    return entered == kOutside || entered >= epoch;
  }
  /// True once every reader that might have seen the state before `epoch` has left.
  [[nodiscard]] bool HasPassed(std::uint64_t epoch) const noexcept {
    for (const Participant* participant = first(); participant != nullptr; participant = participant->next) {
      if (!HasPassed(*participant, epoch)) return false;
    }
    return true;
  }

  [[nodiscard]] Participant* first() const noexcept {
    // acquire: pairs with the release in Add().
    return participants_.load(std::memory_order_acquire);
  }

  static constexpr std::uint64_t kOutside = 0;

 private:
  Atomic<std::uint64_t> epoch_{1};
  Atomic<Participant*> participants_{nullptr};
};

}  // namespace runnel

#pragma once

#include <atomic>
#include <cstdint>

#include "core/lockfree/cache_line.h"

namespace runnel {

/// Lets threads read shared structures without a lock while others replace parts of them: a part
/// that has been taken out is destroyed only when no reader can still look at it.
///
///     reader:  Enter ─ load pointer ─ use what it points to ─ Leave
///     writer:  swap pointer ─ epoch = Advance() ─ … until HasPassed(epoch) … ─ delete the old part
///
/// Every operation that takes part is sequentially consistent, which gives the one argument needed:
/// if HasPassed() sees a reader outside, then the reader's next Enter comes after the swap in the
/// single total order, and its loads find the new pointer. Pointers that readers load must be
/// loaded and swapped with std::memory_order_seq_cst too.
///
/// Threads:     a Participant belongs to one thread; the rest may be called from any thread.
/// Progress:    Enter and Leave are wait-free. They write to the thread's own line only.
/// Allocation:  none. The domain never frees participants; it is told of them by Add().
/// @tparam Atomic  replaced in tests.
template <template <typename> class Atomic = std::atomic>
class EpochDomain {
 public:
  /// One thread's part. Nested entries are counted, and only the outermost pays.
  struct alignas(kCacheLineSize) Participant {
    Atomic<std::uint64_t> entered{kOutside};
    Participant* next = nullptr;  // written before the participant is added, then constant
    Atomic<bool> taken{true};     // by a living thread
    std::uint32_t depth = 0;      // the thread's own
  };

  /// Makes the domain look at `participant` for ever after.
  void Add(Participant& participant) noexcept {
    Participant* head = participants_.load(std::memory_order_seq_cst);
    do {
      participant.next = head;
    } while (!participants_.compare_exchange_weak(head, &participant, std::memory_order_seq_cst,
                                                  std::memory_order_seq_cst));
  }

  void Enter(Participant& participant) noexcept {
    if (participant.depth++ > 0) return;
    participant.entered.store(epoch_.load(std::memory_order_seq_cst), std::memory_order_seq_cst);
  }
  void Leave(Participant& participant) noexcept {
    if (--participant.depth > 0) return;
    // release: what the reader did with the old parts is done before a writer sees it outside.
    participant.entered.store(kOutside, std::memory_order_release);
  }

  /// Starts a new epoch, after a part has been taken out, and returns it.
  [[nodiscard]] std::uint64_t Advance() noexcept {
    return epoch_.fetch_add(1, std::memory_order_seq_cst) + 1;
  }

  /// True once this reader, if it might have seen the state before `epoch`, has left.
  [[nodiscard]] static bool HasPassed(const Participant& participant,
                                      std::uint64_t epoch) noexcept {
    // seq_cst: in one order with Enter() and with the swap; it acquires what Leave() released.
    const std::uint64_t entered = participant.entered.load(std::memory_order_seq_cst);
    return entered == kOutside || entered >= epoch;
  }
  /// True once every reader that might have seen the state before `epoch` has left.
  [[nodiscard]] bool HasPassed(std::uint64_t epoch) const noexcept {
    for (const Participant* participant = first(); participant != nullptr;
         participant = participant->next) {
      if (!HasPassed(*participant, epoch)) return false;
    }
    return true;
  }

  [[nodiscard]] Participant* first() const noexcept {
    return participants_.load(std::memory_order_seq_cst);
  }

  static constexpr std::uint64_t kOutside = 0;

 private:
  Atomic<std::uint64_t> epoch_{1};
  Atomic<Participant*> participants_{nullptr};
};

}  // namespace runnel

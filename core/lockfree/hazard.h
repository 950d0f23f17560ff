#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/lockfree/cache_line.h"

namespace runnel {

/// Where a reader says which buffer it holds.
template <template <typename> class Atomic = std::atomic>
struct HazardSlot {
  Atomic<void*> held{nullptr};  ///< nullptr: the slot is free
};

/// Which buffers one thread protects from reuse: it writes a buffer's address into a free slot of
/// its own record, where whoever wants to reuse buffers looks. Reading so writes to no memory that
/// another reader writes to.
///
/// Threads:     slots are filled by the thread that the record belongs to, and emptied by any.
/// Allocation:  none. Source: M. Michael, "Hazard Pointers" (2004).
template <template <typename> class Atomic = std::atomic, std::size_t kSlots = 7>
struct alignas(kCacheLineSize) HazardRecord {
  using Slot = HazardSlot<Atomic>;

  /// A slot of the calling thread that is free, or nullptr.
  [[nodiscard, gnu::always_inline]] Slot* FindFreeSlot() noexcept {
    // acquire: another thread may have emptied it, by dropping a lease that was handed to it. What
    // that thread read is over then also for who sees only our next use of the slot.
    if (slots[0].held.load(std::memory_order_acquire) == nullptr) [[likely]]
      return &slots[0];
    for (Slot& slot : slots) {
      if (slot.held.load(std::memory_order_acquire) == nullptr) return &slot;
    }
    return nullptr;
  }

  std::array<Slot, kSlots> slots{};
  std::uint64_t bit = 0;         ///< names the record in HazardDomain; constant once it is added
  std::uint64_t own_bit = 0;     ///< the same, or 0 if others share the bit
  HazardRecord* next = nullptr;  ///< constant once added
};

/// What is deleted when no reader holds any part of it (HazardDomain::Retire()): a closed pool.
template <template <typename> class Atomic = std::atomic>
class Retirable {
 public:
  virtual ~Retirable() = default;

 private:
  template <template <typename> class, std::size_t>
  friend class HazardDomain;

  /// Called by one thread at a time. Once false, for ever.
  [[nodiscard]] virtual bool IsHeld() noexcept = 0;

  Retirable* next_retired_ = nullptr;
};

/// The records of a process, each with a bit, so that a set of records is one word; and what waits for
/// those who have left to be deleted.
///
/// Threads:     any. Progress: Add(), Retire() and Reclaim() are lock-free, the rest wait-free.
/// Allocation:  none; Retire() and Reclaim() free memory, and are not for a cycle.
/// Limits:      none; but records beyond the 63rd share one bit, and are then looked at together.
template <template <typename> class Atomic = std::atomic, std::size_t kSlots = 7>
class HazardDomain {
 public:
  using Record = HazardRecord<Atomic, kSlots>;

  /// Makes the domain look at `record` for ever after.
  void Add(Record& record) noexcept {
    // relaxed: the number only has to be another one for each.
    const std::uint64_t number = added_.fetch_add(1, std::memory_order_relaxed);
    if (number < kOwnBits) {
      record.bit = record.own_bit = std::uint64_t{1} << number;
      // release: pairs with the acquire in ForEach(); the record is complete.
      records_[number].store(&record, std::memory_order_release);
      return;
    }
    record.bit = kOthers;
    Record* head = others_.load(std::memory_order_relaxed);
    do {
      record.next = head;
      // release: as above.
    } while (!others_.compare_exchange_weak(head, &record, std::memory_order_release, std::memory_order_relaxed));
  }

  /// Calls `visit(record)` for all records of which `bits` has the bit.
  template <typename Visit>
  void ForEach(std::uint64_t bits, Visit&& visit) const {
    for (std::uint64_t own = bits & (kOthers - 1); own != 0; own &= own - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(own));
      // acquire: pairs with the release in Add(). Null for a thread that is just being added, and
      // has protected nothing yet.
      if (Record* record = records_[i].load(std::memory_order_acquire)) visit(*record);
    }
    if ((bits >> kOwnBits) == 0) return;
    for (Record* each = others_.load(std::memory_order_acquire); each != nullptr; each = each->next) {
      visit(*each);
    }
  }
  static constexpr std::uint64_t kAll = ~std::uint64_t{0};

  /// Takes over `part`, and deletes it as soon as a Reclaim() finds that nobody holds it: at once, if
  /// so it is. Precondition: nobody begins to hold it, but by copying a hold.
  void Retire(Retirable<Atomic>& part) noexcept {
    PushRetired(part);
    (void)Reclaim();
  }
  /// Deletes what has been retired and is not held any more. Returns how many parts are left, but for
  /// those that another thread is looking at just now.
  [[gnu::noinline]] std::size_t Reclaim() noexcept {
    // Nobody takes single parts off the list, so no address in it can come back to life (no ABA).
    // relaxed: only whether there is something.
    if (retired_.load(std::memory_order_relaxed) == nullptr) return 0;
    std::size_t left = 0;
    while (DeleteFree(left) && left > 0) {  // what has been deleted may have held what is left
    }
    return left;
  }

 private:
  // Deletes what of the retired is not held; false if there is none. Says how much is left.
  bool DeleteFree(std::size_t& left) noexcept {
    // acquire: pairs with the release in PushRetired(): the part is complete, and whoever looked at it
    // before has ended.
    Retirable<Atomic>* part = retired_.exchange(nullptr, std::memory_order_acquire);
    bool is_any_deleted = false;
    left = 0;
    while (part != nullptr) {
      Retirable<Atomic>* const next = part->next_retired_;
      if (part->IsHeld()) {
        PushRetired(*part);
        ++left;
      } else {
        delete part;
        is_any_deleted = true;
      }
      part = next;
    }
    return is_any_deleted;
  }
  void PushRetired(Retirable<Atomic>& part) noexcept {
    part.next_retired_ = retired_.load(std::memory_order_relaxed);
    // release: pairs with the acquire in Reclaim().
    while (!retired_.compare_exchange_weak(part.next_retired_, &part, std::memory_order_release,
                                           std::memory_order_relaxed)) {
    }
  }

  static constexpr std::size_t kOwnBits = 9 * kSlots;  // 63; fewer in tests
  static_assert(kOwnBits < 64);
  static constexpr std::uint64_t kOthers = std::uint64_t{1} << kOwnBits;

  std::array<Atomic<Record*>, kOwnBits> records_{};
  Atomic<Record*> others_{nullptr};
  Atomic<std::uint64_t> added_{0};
  Atomic<Retirable<Atomic>*> retired_{nullptr};
};

}  // namespace runnel

#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>

#include "core/base/check.h"
#include "core/lockfree/cache_line.h"
#include "core/lockfree/queue_cells.h"

namespace runnel {

/// A first-in-first-out queue of fixed capacity for any number of writers and readers.
///
/// Each cell counts sequence numbers: 2k when it is free for its k-th use, 2k + 1 while it is filled for the
/// k-th time (after D. Vyukov's bounded queue, with the laps of E. Rigtorp's). A position is a lap and an index in
/// one number, the index in its low bits, so that nobody divides.
///
/// Ownership:   the queue owns what lies in it, and destroys the rest in its destructor.
/// Threads:     all members but the constructor and the destructor, from any thread, at any time.
/// Progress:    a call repeats only if another call has claimed a cell. A thread stopped between
///              claiming and filling a cell hides that cell and those behind it from readers, who
///              are told "empty" and do not wait.
/// Allocation:  in the constructor only.
template <typename T, template <typename> class Atomic = std::atomic>
class BoundedQueue {
  static_assert(std::is_nothrow_move_constructible_v<T> && std::is_nothrow_destructible_v<T>,
                "a value that throws while it is moved would leave its cell claimed for ever");

 public:
  /// Precondition: capacity > 0.
  explicit BoundedQueue(std::size_t capacity)
      : capacity_(capacity),
        index_bits_(static_cast<unsigned>(std::bit_width(capacity - 1))),
        cells_(MakeQueueCells<Cell>(capacity)) {
    RUNNEL_CHECK(capacity > 0, "a queue needs room for one value at least");
  }
  ~BoundedQueue() {
    while (TryConsume([](T&) {})) {
    }
  }
  BoundedQueue(const BoundedQueue&) = delete;
  BoundedQueue& operator=(const BoundedQueue&) = delete;

  /// Moves `value` into the queue; leaves it untouched and returns false if the queue is full.
  [[nodiscard]] bool TryPush(T&& value) noexcept { return TryEmplace(std::move(value)); }
  /// Makes a T of `parts` in the queue; leaves them untouched and returns false if it is full.
  template <typename... Parts>
  [[nodiscard]] bool TryEmplace(Parts&&... parts) noexcept {
    static_assert(std::is_nothrow_constructible_v<T, Parts&&...>);
    // relaxed: the position alone orders nothing; the cell's sequence does.
    std::uint64_t position = tail_.load(std::memory_order_relaxed);
    for (;;) {
      Cell& cell = cells_[Index(position)];
      const std::uint64_t free_sequence = 2 * Lap(position);
      // acquire: pairs with the release in TryConsume(): the old value is gone.
      const std::uint64_t sequence = cell.sequence.load(std::memory_order_acquire);
      if (sequence == free_sequence) {
        // relaxed: claims the position, publishes nothing.
        if (tail_.compare_exchange_weak(position, Next(position), std::memory_order_relaxed,
                                        std::memory_order_relaxed)) {
          std::construct_at(&cell.value, std::forward<Parts>(parts)...);
          // release: pairs with the acquire in TryConsume(): the value is in place.
          cell.sequence.store(free_sequence + 1, std::memory_order_release);
          return true;
        }
      } else if (sequence < free_sequence) {
        return false;  // filled a lap ago and not yet emptied
      } else {
        position = tail_.load(std::memory_order_relaxed);  // another writer was faster
      }
    }
  }

  /// Moves the oldest value out to `value`; returns false if there is none.
  [[nodiscard]] bool TryPop(T& value) noexcept {
    static_assert(std::is_nothrow_move_assignable_v<T>);
    return TryConsume([&value](T& oldest) { value = std::move(oldest); });
  }
  /// Calls `use(oldest)` with the oldest value where it lies, then destroys it; returns false if
  /// there is none. `use` must not throw; until it ends, the cell is not free.
  template <typename Use>
  [[nodiscard]] bool TryConsume(Use&& use) noexcept {
    return TryConsumeIf([] { return true; }, std::forward<Use>(use));
  }
  /// The same, but asks `may()` first, when the oldest value has been seen: what its writer had done
  /// before is visible then. If not, the value stays and false is returned.
  template <typename May, typename Use>
  [[nodiscard]] bool TryConsumeIf(May&& may, Use&& use) noexcept {
    std::uint64_t position = head_.load(std::memory_order_relaxed);
    for (;;) {
      Cell& cell = cells_[Index(position)];
      const std::uint64_t full_sequence = 2 * Lap(position) + 1;
      // acquire: pairs with the release in TryEmplace().
      const std::uint64_t sequence = cell.sequence.load(std::memory_order_acquire);
      if (sequence == full_sequence) {
        if (!may()) return false;
        // Fails if another reader took the value meanwhile; the next one needs an answer of its own.
        if (head_.compare_exchange_weak(position, Next(position), std::memory_order_relaxed,
                                        std::memory_order_relaxed)) {
          use(cell.value);
          std::destroy_at(&cell.value);  // gives back at once what the value held
          // release: pairs with the acquire in TryEmplace() a lap later.
          cell.sequence.store(full_sequence + 1, std::memory_order_release);
          return true;
        }
      } else if (sequence < full_sequence) {
        return false;
      } else {
        position = head_.load(std::memory_order_relaxed);
      }
    }
  }

  /// Whether there is an oldest value to take out; outdated when other threads use the queue.
  [[nodiscard]] bool HasOldest() const noexcept {
    for (;;) {
      const std::uint64_t position = head_.load(std::memory_order_relaxed);
      const std::uint64_t full_sequence = 2 * Lap(position) + 1;
      // acquire: as in TryConsume(), so that a later sequence shows a later head.
      const std::uint64_t sequence = cells_[Index(position)].sequence.load(std::memory_order_acquire);
      if (sequence <= full_sequence) return sequence == full_sequence;
    }
  }

  [[nodiscard]] std::size_t capacity() const noexcept { return capacity_; }
  /// How many values lie in the queue; already outdated when other threads use it.
  [[nodiscard]] std::size_t size() const noexcept {
    const std::uint64_t head = head_.load(std::memory_order_relaxed);
    const std::uint64_t tail = tail_.load(std::memory_order_relaxed);
    if (tail <= head) return 0;
    return (Lap(tail) - Lap(head)) * capacity_ + Index(tail) - Index(head);
  }

 private:
  // The sequence lies behind the value, where the writer ends: else a reader that asks for it would take the
  // first line away while the writer is at the others.
  struct alignas(kCacheLineSize) Cell {
    Cell() noexcept {}
    ~Cell() {}

    union {
      T value;  // there while the sequence is odd
    };
    Atomic<std::uint64_t> sequence{0};
  };

  [[nodiscard]] std::size_t Index(std::uint64_t position) const noexcept {
    return position & ((std::uint64_t{1} << index_bits_) - 1);
  }
  [[nodiscard]] std::uint64_t Lap(std::uint64_t position) const noexcept { return position >> index_bits_; }
  [[nodiscard]] std::uint64_t Next(std::uint64_t position) const noexcept {
    return Index(position) + 1 != capacity_ ? position + 1 : (Lap(position) + 1) << index_bits_;
  }

  const std::size_t capacity_;
  const unsigned index_bits_;
  const std::unique_ptr<Cell[]> cells_;
  alignas(kCacheLineSize) Atomic<std::uint64_t> head_{0};
  alignas(kCacheLineSize) Atomic<std::uint64_t> tail_{0};
};

}  // namespace runnel

#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "core/base/check.h"
#include "core/lockfree/cache_line.h"

namespace runnel {

/// A first-in-first-out queue of fixed capacity for any number of writers and readers.
///
/// Each cell counts turns: 2k when it is free for its k-th use, 2k + 1 while it is filled for the
/// k-th time (after D. Vyukov's bounded queue, with the turns of E. Rigtorp's).
///
/// Ownership:   the queue owns what lies in it, and destroys the rest in its destructor.
/// Threads:     all members but the constructor and the destructor, from any thread, at any time.
/// Progress:    a call repeats only if another call has claimed a cell. A thread stopped between
///              claiming and filling a cell hides that cell and those behind it from readers, who
///              are told "empty" and do not wait.
/// Allocation:  in the constructor only.
template <typename T, template <typename> class Atomic = std::atomic>
class BoundedQueue {
 public:
  /// Precondition: capacity > 0.
  explicit BoundedQueue(std::size_t capacity)
      : capacity_(capacity), cells_(std::make_unique<Cell[]>(capacity)) {
    RUNNEL_CHECK(capacity > 0, "a queue needs room for one value at least");
  }
  BoundedQueue(const BoundedQueue&) = delete;
  BoundedQueue& operator=(const BoundedQueue&) = delete;

  /// Moves `value` into the queue; leaves it untouched and returns false if the queue is full.
  [[nodiscard]] bool TryPush(T&& value) noexcept {
    // relaxed: the position alone orders nothing; the cell's turn does.
    std::uint64_t position = tail_.load(std::memory_order_relaxed);
    for (;;) {
      Cell& cell = cells_[position % capacity_];
      const std::uint64_t free_turn = 2 * (position / capacity_);
      // acquire: pairs with the release in TryPop(): the reader has moved the old value out.
      const std::uint64_t turn = cell.turn.load(std::memory_order_acquire);
      if (turn == free_turn) {
        // relaxed: claims the position, publishes nothing.
        if (tail_.compare_exchange_weak(position, position + 1, std::memory_order_relaxed,
                                        std::memory_order_relaxed)) {
          cell.value = std::move(value);
          // release: pairs with the acquire in TryPop(): the value is in place.
          cell.turn.store(free_turn + 1, std::memory_order_release);
          return true;
        }
      } else if (turn < free_turn) {
        return false;  // filled a lap ago and not yet emptied
      } else {
        position = tail_.load(std::memory_order_relaxed);  // another writer was faster
      }
    }
  }

  /// Moves the oldest value out to `value`; returns false if there is none.
  [[nodiscard]] bool TryPop(T& value) noexcept {
    std::uint64_t position = head_.load(std::memory_order_relaxed);
    for (;;) {
      Cell& cell = cells_[position % capacity_];
      const std::uint64_t full_turn = 2 * (position / capacity_) + 1;
      // acquire: pairs with the release in TryPush().
      const std::uint64_t turn = cell.turn.load(std::memory_order_acquire);
      if (turn == full_turn) {
        if (head_.compare_exchange_weak(position, position + 1, std::memory_order_relaxed,
                                        std::memory_order_relaxed)) {
          value = std::move(cell.value);
          cell.value = T{};  // gives back at once what the value held
          // release: pairs with the acquire in TryPush() a lap later.
          cell.turn.store(full_turn + 1, std::memory_order_release);
          return true;
        }
      } else if (turn < full_turn) {
        return false;
      } else {
        position = head_.load(std::memory_order_relaxed);
      }
    }
  }

  [[nodiscard]] std::size_t capacity() const noexcept { return capacity_; }
  /// How many values lie in the queue; already outdated when other threads use it.
  [[nodiscard]] std::size_t size() const noexcept {
    const std::uint64_t head = head_.load(std::memory_order_relaxed);
    const std::uint64_t tail = tail_.load(std::memory_order_relaxed);
    return tail > head ? static_cast<std::size_t>(tail - head) : 0;
  }

 private:
  struct alignas(kCacheLineSize) Cell {
    Atomic<std::uint64_t> turn{0};
    T value{};
  };

  const std::size_t capacity_;
  const std::unique_ptr<Cell[]> cells_;
  alignas(kCacheLineSize) Atomic<std::uint64_t> head_{0};
  alignas(kCacheLineSize) Atomic<std::uint64_t> tail_{0};
};

}  // namespace runnel

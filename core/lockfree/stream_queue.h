#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>

#include "core/base/check.h"
#include "core/lockfree/cache_line.h"
#include "core/lockfree/queue_cells.h"

namespace runnel {

/// A first-in-first-out queue of fixed capacity between one writer and one reader.
///
///                head (reader) ──▼               ▼── tail (writer)
///     cells   │ free │ free │ sequence 7 │ sequence 8 │ sequence 9 │ free │ …      sequence = position + 1
///
/// A ring (after L. Lamport, 1977) whose two sides touch each other's lines as seldom as can be: the
/// reader sees by the cell itself whether it is filled, since it needs that line anyway (after
/// J. Giacomoni et al., "FastForward", 2008); the writer keeps its own copy of the reader's position
/// and looks at the real one only when by that copy the queue is full. Nothing is ever written by
/// both sides but the cells.
///
/// Ownership:   the queue owns what lies in it, and destroys the rest in its destructor.
/// Threads:     one at a time may TryPush(); one at a time may Front(), PopFront() and TryPop();
///              the two may differ, and may change if the change is itself ordered (a lock, a
///              scheduler). size() from any thread.
/// Progress:    wait-free, both sides, whatever becomes of the other.
/// Allocation:  in the constructor only.
/// No data race: a cell's value is touched by the writer while it is free, by the reader while it is
///              filled. Positions do not wrap within 2^64 values.
/// @tparam T       can be moved without throwing.
/// @tparam Atomic  replaced in tests. @tparam Plain  how the sides keep their own notes; replaced in
///                 tests by what reports two threads that touch one of them.
template <typename T, template <typename> class Atomic = std::atomic,
          template <typename> class Plain = std::type_identity_t>
class StreamQueue {
  static_assert(std::is_nothrow_move_constructible_v<T> && std::is_nothrow_destructible_v<T>,
                "a value that throws while it is moved would be lost between writer and reader");

 public:
  /// Precondition: capacity > 0.
  explicit StreamQueue(std::size_t capacity) : capacity_(capacity), cells_(MakeQueueCells<Cell>(capacity)) {
    RUNNEL_CHECK(capacity > 0, "a queue needs room for one value at least");
  }
  ~StreamQueue() {
    while (Front() != nullptr) PopFront();
  }
  StreamQueue(const StreamQueue&) = delete;
  StreamQueue& operator=(const StreamQueue&) = delete;

  /// Moves `value` into the queue; leaves it untouched and returns false if the queue is full.
  [[nodiscard]] bool TryPush(T&& value) noexcept { return TryEmplace(std::move(value)); }
  /// Makes a T of `parts` in the queue; leaves them untouched and returns false if it is full.
  template <typename... Parts>
  [[nodiscard, gnu::always_inline]] bool TryEmplace(Parts&&... parts) noexcept {
    static_assert(std::is_nothrow_constructible_v<T, Parts&&...>);
    if (!HasCapacity()) return false;
    const std::uint64_t position = tail_.load(std::memory_order_relaxed);
    const std::size_t index = write_index_;
    Cell& cell = cells_[index];
    std::construct_at(&cell.value, std::forward<Parts>(parts)...);
    // release: pairs with the acquire in Front(): the value is in place.
    cell.sequence.store(position + 1, std::memory_order_release);
    // relaxed: for the writer itself and for size().
    tail_.store(position + 1, std::memory_order_relaxed);
    write_index_ = Next(index);
    return true;
  }

  /// Whether the next value will find room. For the writer, whom nobody else can take it from.
  [[nodiscard]] bool HasCapacity() noexcept {
    // relaxed: the writer's own.
    const std::uint64_t position = tail_.load(std::memory_order_relaxed);
    if (position - seen_head_ < capacity_) return true;
    // acquire: pairs with the release in PopFront(): the reader is done with the cells before.
    seen_head_ = head_.load(std::memory_order_acquire);
    return position - seen_head_ < capacity_;
  }

  /// The oldest value, which stays where it is until PopFront(); nullptr if there is none. The
  /// reader may change it, or move from it.
  [[nodiscard]] T* Front() noexcept {
    Cell& cell = cells_[read_index_];
    // relaxed: the reader's own.
    const std::uint64_t position = head_.load(std::memory_order_relaxed);
    // acquire: pairs with the release in TryEmplace().
    return cell.sequence.load(std::memory_order_acquire) == position + 1 ? &cell.value : nullptr;
  }
  /// Destroys the oldest value. Precondition: Front() is not nullptr.
  void PopFront() noexcept {
    const std::size_t index = read_index_;
    std::destroy_at(&cells_[index].value);
    read_index_ = Next(index);
    // release: pairs with the acquire in TryEmplace(): the reader is done with the cell.
    head_.store(head_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }
  /// Moves the oldest value out to `value`; returns false if there is none.
  [[nodiscard]] bool TryPop(T& value) noexcept {
    static_assert(std::is_nothrow_move_assignable_v<T>);
    T* const front = Front();
    if (front == nullptr) return false;
    value = std::move(*front);
    PopFront();
    return true;
  }

  [[nodiscard]] std::size_t capacity() const noexcept { return capacity_; }
  /// How many values lie in the queue; already outdated when other threads use it.
  [[nodiscard]] std::size_t size() const noexcept {
    const std::uint64_t head = head_.load(std::memory_order_relaxed);
    const std::uint64_t tail = tail_.load(std::memory_order_relaxed);
    return tail > head ? static_cast<std::size_t>(tail - head) : 0;
  }

 private:
  // Begins on a line of its own: else the reader that waits for it would take from the writer the
  // line in which the value before ends. The sequence lies behind the value, where the writer ends: else
  // the reader that asks for it would take the first line away while the writer is at the others.
  struct alignas(kCacheLineSize) Cell {
    Cell() noexcept {}
    ~Cell() {}

    union {
      T value;  // there while sequence is that of a position between head and tail
    };
    Atomic<std::uint64_t> sequence{0};
  };

  // A division would cost as much as all the rest.
  [[nodiscard]] std::size_t Next(std::size_t index) const noexcept { return index + 1 == capacity_ ? 0 : index + 1; }

  const std::size_t capacity_;
  const std::unique_ptr<Cell[]> cells_;
  alignas(kCacheLineSize) Atomic<std::uint64_t> tail_{0};  // the writer's line
  Plain<std::uint64_t> seen_head_{0};
  Plain<std::size_t> write_index_{0};
  alignas(kCacheLineSize) Atomic<std::uint64_t> head_{0};  // the reader's line
  Plain<std::size_t> read_index_{0};
};

}  // namespace runnel

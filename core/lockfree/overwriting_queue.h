#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>

#include "core/base/check.h"
#include "core/lockfree/cache_line.h"
#include "core/lockfree/queue_cells.h"

namespace runnel {

/// A first-in-first-out queue of fixed capacity between one writer and one reader, that never refuses for being
/// full: who needs room takes the oldest value out.
///
///                        head ──▼               ▼── tail (writer)
///     cells   │ free │ claimed │ sequence 7 │ sequence 8 │ sequence 9 │ free │ …   sequence = position + 1
///                        └ by the reader, who says in `released` when it is done
///
/// The reader and whoever drops the oldest claim it by moving `head` past it, so that each value is taken by one of
/// them. The reader then uses it where it lies, and writes to no cell: the writer finds the cells as it left them
/// (as in StreamQueue). A cell more than the capacity lets the writer go on meanwhile (after iceoryx's overflowing
/// queue, whose reader copies first and claims then). The reader claims one value at a time, though several would be
/// faster: what is claimed cannot be dropped, and a writer that comes round to it would lose its newest values instead.
///
/// Invariants:  a position is claimed once, by a step of `head`. The writer fills a cell again when the value that
///              lay there has been released by the reader, or dropped. The reader claims no further positions
///              before it has released the last: so `released` past a position says that this one is free, if the
///              reader had it.
/// Ownership:   the queue owns what lies in it, and destroys the rest in its destructor.
/// Threads:     one at a time may TryEmplace() and DropOldest(); one at a time may Front() and PopFront(); both
///              may change if the change is itself ordered. DropOldestFromOutside() and size() from any thread.
/// Progress:    wait-free for the writer as long as there is room; else who claims repeats only if another has claimed.
///              A reader that is stopped between Front() and PopFront() keeps its cell: the writer is told when it
///              comes round to it.
/// Allocation:  in the constructor only.
/// @tparam Plain  how the sides keep their own notes; replaced in tests, as Atomic.
template <typename T, template <typename> class Atomic = std::atomic,
          template <typename> class Plain = std::type_identity_t>
class OverwritingQueue {
  static_assert(std::is_nothrow_move_constructible_v<T> && std::is_nothrow_destructible_v<T>,
                "a value that throws while it is moved would be lost between writer and reader");

 public:
  /// Precondition: capacity > 0.
  explicit OverwritingQueue(std::size_t capacity)
      : capacity_(capacity), cells_(MakeQueueCells<Cell>(CellsFor(capacity))), writable_(capacity) {
    RUNNEL_CHECK(capacity > 0, "a queue needs room for one value at least");
  }
  ~OverwritingQueue() {
    if (claimed() > 0) PopFront();
    while (DropOldest()) {
    }
  }
  OverwritingQueue(const OverwritingQueue&) = delete;
  OverwritingQueue& operator=(const OverwritingQueue&) = delete;

  /// Makes a T of `parts` in the queue; leaves them untouched and returns false if the queue is full, or if the
  /// reader is still at the cell that comes next.
  template <typename... Parts>
  [[nodiscard, gnu::always_inline]] bool TryEmplace(Parts&&... parts) noexcept {
    static_assert(std::is_nothrow_constructible_v<T, Parts&&...>);
    // relaxed: the writer's own.
    const std::uint64_t position = tail_.load(std::memory_order_relaxed);
    if (position >= writable_ && !LookForRoom(position)) [[unlikely]]
      return false;
    const std::size_t index = write_index_;
    Cell& cell = cells_[index];
    std::construct_at(&cell.value, std::forward<Parts>(parts)...);
    // release: pairs with the acquire in Claim() and Drop(): the value is in place.
    cell.sequence.store(position + 1, std::memory_order_release);
    // relaxed: for the writer itself and for size().
    tail_.store(position + 1, std::memory_order_relaxed);
    write_index_ = index + 1 == cells() ? 0 : index + 1;
    return true;
  }

  /// Claims the oldest value, which is the reader's until PopFront(), and stays where it is; the one claimed last, if
  /// that is still there. nullptr if there is none. The reader may change it, or move from it.
  [[nodiscard, gnu::always_inline]] T* Front() noexcept {
    if (claimed() == 0 && !Claim()) return nullptr;
    return &cells_[read_index_].value;
  }
  /// Destroys the value that Front() has claimed. Precondition: Front() is not nullptr.
  void PopFront() noexcept {
    const std::size_t index = read_index_;
    std::destroy_at(&cells_[index].value);
    read_index_ = index + 1 == cells() ? 0 : index + 1;
    const std::uint64_t position = read_position_ + 1;
    read_position_ = position;
    // relaxed: the reader's own, and for who asks how many.
    claimed_.store(0, std::memory_order_relaxed);
    // release: pairs with the acquire in LookForRoom(): the reader is done with the cell.
    released_.store(position, std::memory_order_release);
  }

  /// Takes the oldest value out and destroys it; false if there is none. By the writer.
  bool DropOldest() noexcept { return Drop(std::memory_order_relaxed); }
  /// The same by any thread. The writer grants itself no further cells meanwhile.
  bool DropOldestFromOutside() noexcept {
    // relaxed: carried by the release of the claim, and by that of the end.
    from_outside_.fetch_add(1, std::memory_order_relaxed);
    const bool dropped = Drop(std::memory_order_release);
    // release: pairs with the acquire in LookForRoom(): this thread is done with the cell.
    from_outside_.fetch_sub(1, std::memory_order_release);
    return dropped;
  }

  /// Whether the reader has a value, or would find one to claim. For the reader.
  [[nodiscard]] bool HasNext() const noexcept {
    if (claimed() > 0) return true;
    for (;;) {
      const std::uint64_t position = head_.load(std::memory_order_relaxed);
      // acquire: so that a later sequence shows a later head.
      const std::uint64_t sequence = CellAt(position).sequence.load(std::memory_order_acquire);
      if (sequence <= position + 1) return sequence == position + 1;
    }
  }
  /// How many the reader has claimed and not yet let go, 0 or 1. Any thread.
  [[nodiscard]] std::size_t claimed() const noexcept { return claimed_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::size_t capacity() const noexcept { return capacity_; }
  /// How many values lie in the queue, without those that the reader has claimed; already outdated when other
  /// threads use it.
  [[nodiscard]] std::size_t size() const noexcept {
    const std::uint64_t head = head_.load(std::memory_order_relaxed);
    const std::uint64_t tail = tail_.load(std::memory_order_relaxed);
    return tail > head ? static_cast<std::size_t>(tail - head) : 0;
  }

 private:
  static constexpr std::size_t kSpare = 2;  // the reader's, and what is written after the oldest has been dropped

  struct alignas(kCacheLineSize) Cell {
    Cell() noexcept {}
    ~Cell() {}

    union {
      T value;  // there while sequence is that of a position between head and tail, or the claimed one
    };
    // Behind the value, where the writer ends: see StreamQueue.
    Atomic<std::uint64_t> sequence{0};
    Atomic<std::uint64_t> dropped{0};  // position + 1 of what was dropped here last
  };

  static std::size_t CellsFor(std::size_t capacity) {
    constexpr std::size_t kMost = std::numeric_limits<std::size_t>::max() - kSpare;
    return capacity > kMost ? capacity : capacity + kSpare;
  }
  [[nodiscard]] std::size_t cells() const noexcept { return capacity_ + kSpare; }
  [[nodiscard]] Cell& CellAt(std::uint64_t position) const noexcept { return cells_[position % cells()]; }
  // Claims the oldest value for the reader, which has none; false if there is none.
  [[gnu::noinline]] bool Claim() noexcept {
    // relaxed: who claims compares it.
    std::uint64_t position = head_.load(std::memory_order_relaxed);
    for (;;) {
      if (position != read_position_) [[unlikely]] {  // others have dropped some
        read_position_ = position;
        read_index_ = position % cells();
      }
      // acquire: pairs with the release in TryEmplace(), of the value.
      const std::uint64_t sequence = cells_[read_index_].sequence.load(std::memory_order_acquire);
      if (sequence == position + 1) {
        // acquire: pairs with the release in DropOldestFromOutside(): who sees this position released sees those
        // who are still dropping one before it. What lies here has been seen by its sequence.
        if (head_.compare_exchange_weak(position, position + 1, std::memory_order_acquire, std::memory_order_relaxed)) {
          claimed_.store(1, std::memory_order_relaxed);
          return true;
        }
      } else if (sequence < position + 1) {
        return false;
      } else {
        position = head_.load(std::memory_order_relaxed);  // dropped and overwritten meanwhile
      }
    }
  }
  // `claiming`: the order of the claim.
  bool Drop(std::memory_order claiming) noexcept {
    std::uint64_t position = head_.load(std::memory_order_relaxed);
    for (;;) {
      Cell& cell = CellAt(position);
      // acquire: as in Claim().
      const std::uint64_t sequence = cell.sequence.load(std::memory_order_acquire);
      if (sequence < position + 1) return false;
      if (sequence > position + 1) {
        position = head_.load(std::memory_order_relaxed);
      } else if (head_.compare_exchange_weak(position, position + 1, claiming, std::memory_order_relaxed)) {
        std::destroy_at(&cell.value);
        // release: pairs with the acquire in LookForRoom(): who drops is done with the cell.
        cell.dropped.store(position + 1, std::memory_order_release);
        return true;
      }
    }
  }
  // For the writer, who has no leave for this position yet. A look at the others' line, and leave for all that
  // is known to be free.
  [[gnu::noinline]] bool LookForRoom(std::uint64_t position) noexcept {
    // relaxed: a claim only makes room; whether the cell is free is another question.
    const std::uint64_t head = head_.load(std::memory_order_relaxed);
    if (position - head >= capacity_) return false;
    // acquire: pairs with the release in PopFront().
    const std::uint64_t released = released_.load(std::memory_order_acquire);
    // Before `released` all is free, whosever it has been, unless somebody from outside is still dropping it.
    // acquire: pairs with the release of who is done.
    const std::uint64_t known = std::min(released + cells(), head + capacity_);
    if (position < known && from_outside_.load(std::memory_order_acquire) == 0) {
      writable_ = known;
      return true;
    }
    if (position < cells()) return true;  // in the first lap
    // The reader is asleep, or behind: this one cell.
    const std::uint64_t before = position - cells();
    // acquire: pairs with the release in DropOldest().
    return CellAt(position).dropped.load(std::memory_order_acquire) == before + 1;
  }

  const std::size_t capacity_;
  const std::unique_ptr<Cell[]> cells_;
  alignas(kCacheLineSize) Atomic<std::uint64_t> tail_{0};  // the writer's line
  Plain<std::uint64_t> writable_;                          // positions before it need no look
  Plain<std::size_t> write_index_{0};
  alignas(kCacheLineSize) Atomic<std::uint64_t> head_{0};  // who claims, and who looks for room
  Atomic<std::uint64_t> released_{0};
  Atomic<std::uint32_t> from_outside_{0};                   // how many drop who are neither reader nor writer
  alignas(kCacheLineSize) Atomic<std::size_t> claimed_{0};  // the reader's line
  Plain<std::uint64_t> read_position_{0};                   // the next one, as far as the reader knows
  Plain<std::size_t> read_index_{0};                        // of its cell
};

}  // namespace runnel

#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>

#include "core/lockfree/cache_line.h"

namespace runnel::genom_execution {

/// Who wants which unit, and who came first: L. Lamport's bakery, with conflicts. Each place wants one unit at a time:
/// who waits holds nothing, and waits only for smaller tickets, so nobody waits for ever.
///
///     Want:   cell = {unit, no ticket yet};  ticket = next++;  cell = {unit, ticket}
///     May:    no other cell has a unit in conflict with no ticket yet, or a smaller one
///     Leave:  cell = nothing
///
/// Why not two at once: of two in conflict one, A, has the smaller ticket. B's fetch_add comes after A's in the order of
/// that variable and acquires what A's, or one that follows it, has released: A's first store. So B's look finds A's unit,
/// without a ticket or with the smaller one, until A has left. What A did before is handed to B by the release of Leave(),
/// or of the second store of A's next turn, and the acquire of the look that finds it. The first store hands on nothing:
/// who finds it waits. Each weaker order makes the search over schedules fail, but that of the second store, which the
/// search takes for a part of what Leave() has released, as C++ did once.
///
/// Threads:    each place by one thread at a time. Progress: wait-free.
template <template <typename> class Atomic = std::atomic>
class TicketBoard {
 public:
  explicit TicketBoard(std::size_t places) : cells_(places) {}

  /// From now on others wait for this one. Precondition: the place wants nothing.
  void Want(std::size_t place, std::size_t unit) noexcept {
    auto& word = cells_[place].word;
    word.store(unit + 1, std::memory_order_relaxed);  // released by the next
    const std::uint64_t ticket = next_.fetch_add(1, std::memory_order_acq_rel);
    word.store(ticket << 16 | (unit + 1), std::memory_order_release);
  }
  /// Whether it may run now. `conflict(a, b)`: of two units.
  template <typename Conflicts>
  [[nodiscard]] bool May(std::size_t place, const Conflicts& conflict) const noexcept {
    const std::uint64_t own = cells_[place].word.load(std::memory_order_relaxed);  // its own store
    for (std::size_t other = 0; other < cells_.size(); ++other) {
      if (other == place) continue;
      const std::uint64_t word = cells_[other].word.load(std::memory_order_acquire);
      if (word != 0 && word >> 16 < own >> 16 && conflict(UnitOf(own), UnitOf(word))) return false;
    }
    return true;
  }
  void Leave(std::size_t place) noexcept { cells_[place].word.store(0, std::memory_order_release); }
  /// Calls `use(other)` with each other place that wants a unit in conflict with this one. Behind a full fence: who
  /// does not find a place here has stored before that place looks.
  template <typename Conflicts, typename Use>
  void ForEachWaiting(std::size_t place, std::size_t unit, const Conflicts& conflict, const Use& use) const noexcept {
    for (std::size_t other = 0; other < cells_.size(); ++other) {
      if (other == place) continue;
      const std::uint64_t word = cells_[other].word.load(std::memory_order_relaxed);
      if (word != 0 && conflict(unit, UnitOf(word))) use(other);
    }
  }
  /// What the place wants. By its thread.
  [[nodiscard]] std::size_t unit(std::size_t place) const noexcept {
    return UnitOf(cells_[place].word.load(std::memory_order_relaxed));
  }

 private:
  struct alignas(kCacheLineSize) Cell {
    Atomic<std::uint64_t> word{0};  // 0: nothing; else ticket << 16 | unit + 1; ticket 0: none yet
  };
  [[nodiscard]] static std::size_t UnitOf(std::uint64_t word) noexcept { return (word & 0xffff) - 1; }

  std::deque<Cell> cells_;
  alignas(kCacheLineSize) Atomic<std::uint64_t> next_{1};
};

}  // namespace runnel::genom_execution

#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "core/lockfree/cache_line.h"
#include "core/lockfree/wake_event.h"
#include "plugins/genom_execution/component_table.h"

namespace runnel::genom_execution {

/// Which units (codels, attributes) must not run at the same time.
class ConflictMatrix {
 public:
  explicit ConflictMatrix(const ComponentTable& component);
  [[nodiscard]] bool HasAny(std::size_t unit) const noexcept { return has_any_[unit]; }
  [[nodiscard]] bool Conflict(std::size_t a, std::size_t b) const noexcept {
    return (bits_[a * words_ + b / 64] >> (b % 64) & 1) != 0;
  }

 private:
  const std::size_t words_;
  std::vector<std::uint64_t> bits_;
  std::vector<bool> has_any_;
};

/// Keeps units that conflict apart, first come first served (L. Lamport's bakery, with conflicts). Each task has a
/// place, and wants one unit at a time: who waits holds nothing, and waits only for smaller tickets, so nobody waits
/// for ever.
///
///     Want:   cell = {unit, no ticket yet};  ticket = next++;  cell = {unit, ticket}
///     May:    no other cell has a unit in conflict with no ticket yet, or a smaller one
///     Leave:  cell = nothing; those who want something are woken
///
/// Why not two at once: of two in conflict one, A, has the smaller ticket. If B's look at A's cell came before A had
/// stored its unit there, A took its ticket after B had taken B's, so A's would be the larger one. So B sees A's unit,
/// without a ticket or with the smaller one, until A has left. This takes one order of all stores, tickets and looks:
/// all are seq_cst. That also hands on what A did: B's look reads what A's Leave() stored.
///
/// Threads:    each place by one thread at a time. Progress: Want(), May(), Leave() are wait-free.
class Exclusion {
 public:
  Exclusion(const ConflictMatrix& conflicts, std::size_t places) : conflicts_(conflicts), cells_(places) {}

  /// From now on others wait for this one. Precondition: the place wants nothing.
  void Want(std::size_t place, std::size_t unit) noexcept;
  /// Whether it may run now.
  [[nodiscard]] bool May(std::size_t place) const noexcept;
  void Leave(std::size_t place) noexcept;
  /// Sleeps until May() is worth asking again. Not in a cycle.
  void Wait(std::size_t place) noexcept { cells_[place].may_look.Wait(); }
  [[nodiscard]] bool WantsAny(std::size_t place) const noexcept {
    return cells_[place].word.load(std::memory_order_relaxed) != 0;
  }

 private:
  struct alignas(kCacheLineSize) Cell {
    std::atomic<std::uint64_t> word{0};  // 0: nothing; else ticket << 16 | unit + 1; ticket 0: none yet
    WakeEvent may_look;
  };
  [[nodiscard]] static std::size_t UnitOf(std::uint64_t word) noexcept { return (word & 0xffff) - 1; }
  void WakeOthers(std::size_t place, std::size_t unit) noexcept;

  const ConflictMatrix& conflicts_;
  std::deque<Cell> cells_;
  alignas(kCacheLineSize) std::atomic<std::uint64_t> next_ticket_{1};
};

}  // namespace runnel::genom_execution

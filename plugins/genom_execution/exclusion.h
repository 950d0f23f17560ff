#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "core/lockfree/wake_event.h"
#include "plugins/genom_execution/component_table.h"
#include "plugins/genom_execution/ticket_board.h"

namespace runnel::genom_execution {

/// Which units (codels, attributes) must not run at the same time.
class ConflictMatrix {
 public:
  explicit ConflictMatrix(const ComponentTable& component);
  [[nodiscard]] bool HasAny(std::size_t unit) const noexcept { return has_any_[unit]; }
  /// Whether it conflicts with an asynchronous codel, which may take long.
  [[nodiscard]] bool HasAsync(std::size_t unit) const noexcept { return has_async_[unit]; }
  [[nodiscard]] bool Conflict(std::size_t a, std::size_t b) const noexcept {
    return (bits_[a * words_ + b / 64] >> (b % 64) & 1) != 0;
  }

 private:
  const std::size_t words_;
  std::vector<std::uint64_t> bits_;
  std::vector<bool> has_any_;
  std::vector<bool> has_async_;
};

/// Keeps units that conflict apart, first come first served, and lets threads sleep until it is their turn.
///
/// Sleeping: who wants stores its ticket, passes a full fence, looks, and sleeps; who leaves, or has got its ticket, stores
/// that, passes a full fence, and wakes whom it finds wanting. So either the look of the one finds the other's store, or
/// the other finds it wanting; notifications stay until they are looked at. Where nobody sleeps there are no fences.
///
/// Threads:    each place by one thread at a time.
class Exclusion {
 public:
  Exclusion(const ConflictMatrix& conflicts, std::size_t places, bool sleeps)
      : conflicts_(conflicts), sleeps_(sleeps), board_(places), may_look_(places) {}

  /// From now on others wait for this one. Precondition: the place wants nothing.
  void Want(std::size_t place, std::size_t unit) noexcept;
  /// Whether it may run now.
  [[nodiscard]] bool May(std::size_t place) const noexcept;
  void Leave(std::size_t place) noexcept;
  /// Sleeps until May() is worth asking again, or until `deadline` by the steady clock. Precondition: made to sleep.
  void Wait(std::size_t place, Time deadline) noexcept { may_look_[place].WaitUntil(deadline); }

 private:
  void WakeOthers(std::size_t place, std::size_t unit) noexcept;

  const ConflictMatrix& conflicts_;
  const bool sleeps_;
  TicketBoard<> board_;
  std::deque<WakeEvent> may_look_;  // by places
};

}  // namespace runnel::genom_execution

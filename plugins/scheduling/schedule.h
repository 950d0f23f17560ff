#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/module/executable.h"
#include "plugins/scheduling/quiescence.h"
#include "plugins/scheduling/scheduled_element.h"

namespace runnel {

class TraceTrack;

/// What one thread does in a cycle, ready to be run through. Never changed once made: a change of
/// the structure makes a new one, and the old one goes when no cycle can be using it.
struct Schedule {
  /// A runner that may still be running an element, since an installation that took it away.
  struct Before {
    std::shared_ptr<const CycleQuiescence> quiescence;
    std::shared_ptr<const Installation> installation;
    [[nodiscard]] bool HasLeft() const noexcept {
      return installation->HasBeenReachedBy(*quiescence);
    }
  };

  struct Entry {
    BoundCall run;
    std::shared_ptr<ScheduledElement> element;
    Phase phase = Phase::kUpdate;
    bool is_first = true;  ///< of the element's tasks
    bool is_last = true;
    /// Those who may still have been running the element when this entry was made.
    std::vector<Before> before = {};

    /// Whether no other thread can be running the element any more; once true it remains so, as
    /// long as a cycle is in a schedule with this entry.
    [[nodiscard]] bool HasArrived() const noexcept {
      for (const Before& each : before) {
        if (!each.HasLeft()) return false;
      }
      return true;
    }
  };

  std::uint64_t number = 0;     ///< later ones of the same runner have higher numbers
  std::vector<Entry> entries;   ///< in the order of running
  bool has_arrivals = false;    ///< elements that others have had before
  TraceTrack* track = nullptr;  ///< where its cycles are noted; nullptr: nowhere
  /// The runners that wait for data; they are told at the end of the cycle, not in the midst of it.
  std::shared_ptr<const std::vector<CycleRunner*>> waiting;
};

}  // namespace runnel

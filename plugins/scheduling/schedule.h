#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/module/executable.h"
#include "plugins/scheduling/handover.h"
#include "plugins/scheduling/scheduled_element.h"

namespace runnel {

/// What one thread does in a cycle, ready to be run through. Never changed once made: a change of
/// the structure makes a new one, and the old one goes when no cycle can be using it.
struct Schedule {
  struct Entry {
    BoundCall run;
    std::shared_ptr<ScheduledElement> element;
    Phase phase = Phase::kUpdate;
    bool is_first = true;  ///< of the element's tasks, in this schedule
    bool is_last = true;
    /// Of the runners that may still be running the element when this schedule is installed.
    std::vector<std::shared_ptr<const CyclePresence>> before = {};
  };

  /// Whether no other thread can be running the element of `entry` any more; once true it remains
  /// so, as long as a cycle is in this schedule.
  [[nodiscard]] bool HasArrived(const Entry& entry) const noexcept {
    for (const auto& presence : entry.before) {
      if (!installation->HasBeenReachedBy(*presence)) return false;
    }
    return true;
  }

  std::uint64_t number = 0;  ///< 1 for the first of its runner
  std::shared_ptr<const Installation> installation;
  std::vector<Entry> entries;
  /// The runners that wait for data; they are told at the end of the cycle, not in the midst of it.
  std::vector<CycleRunner*> waiting;
};

}  // namespace runnel

#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/module/executable.h"
#include "plugins/scheduling/scheduled_element.h"

namespace runnel {

/// What one thread does in a cycle, ready to be run through. Never changed once made: a change of
/// the structure makes a new one, and the old one goes when no cycle can be using it.
struct Schedule {
  struct Entry {
    std::function<void()> run;
    std::shared_ptr<ScheduledElement> element;
    Phase phase = Phase::kUpdate;
    bool is_first = true;  ///< of the element's tasks, in this schedule
    bool is_last = true;
  };

  std::vector<Entry> entries;
  /// The runners that wait for data; they are told at the end of the cycle, not in the midst of it.
  std::vector<CycleRunner*> waiting;
};

}  // namespace runnel

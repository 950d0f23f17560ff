#pragma once

#include <string>
#include <vector>

#include "plugins/scheduling/cycle_runner.h"
#include "plugins/scheduling/scheduler.h"

namespace runnel::test {

/// One task as it is scheduled.
struct ScheduledTask {
  std::string path;  ///< of the element
  Phase phase;
  friend bool operator==(const ScheduledTask&, const ScheduledTask&) = default;
};

/// What the thread runs, in the order of its running, with the schedules brought up to date.
inline std::vector<ScheduledTask> OrderOf(Scheduler& scheduler, const ThreadContainer& thread) {
  const std::lock_guard lock(thread.runtime().structure_mutex());
  (void)scheduler.HasTasks();
  std::vector<ScheduledTask> order;
  const Schedule* const schedule = thread.runner()->schedule();
  if (schedule == nullptr) return order;
  for (const auto& entry : schedule->entries) order.push_back({entry.element->path(), entry.phase});
  return order;
}

}  // namespace runnel::test

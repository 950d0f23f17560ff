#pragma once

#include <vector>

#include "core/base/error.h"
#include "core/module/executable.h"

namespace runnel {

/// The order in which the tasks of one thread run, and the connections that it could not follow.
struct ExecutionOrder {
  std::vector<Task> tasks;
  /// One warning for each connection over which data arrives one cycle late because it closes a
  /// loop; each names both ports.
  std::vector<Error> cuts;
};

/// Brings tasks into the order of the data flow, so that what the first one measures reaches the
/// last one in the same cycle.
///
/// An edge leads from the task that writes a group to each task that reads a group in which a port
/// is fed by it, through however many interface ports. Besides, the tasks of one element keep the
/// order of their phases. Rules, in this order:
///   1. An edge from a control task into a sense task is the feedback through the robot: not
///   followed,
///      and not reported.
///   2. All other edges are followed, as long as they form no loop.
///   3. Of the tasks that are free to run, the one with the earlier phase comes first, then the one
///      whose element was made earlier (id), then the one named earlier by its element.
///   4. If none is free, the tasks left contain loops. Of those loops that no other loop feeds, the
///      task that rule 3 puts first runs next; the edges into it from tasks that are left are cut,
///      and each of their connections is reported. A task that feeds itself is reported likewise.
///      After 32 such cuts, each within the loop that the one before has left, what is left of it runs
///      by rule 3 alone, and every connection against that is cut.
/// No address and no clock enters: the same application gives the same order and the same cuts.
///
/// Threads:     under the structure lock. Effort: O(n log n) for n tasks and connections without
///              loops; more where many lie in one loop. Allocates.
/// Errors:      none; groups that are nullptr are skipped.
/// Source:      the sorting of S. Kahn, "Topological sorting of large networks" (1962).
[[nodiscard]] ExecutionOrder OrderTasks(std::vector<Task> tasks);

}  // namespace runnel

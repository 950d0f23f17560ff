#pragma once

#include <cstdint>
#include <vector>

#include "plugins/task_order/running_order.h"

namespace runnel::internal {

using Tasks = std::vector<OrderedTask*>;

/// Writes a number that nobody had before into the `set` of each, by which they can be told from all
/// others.
std::uint64_t MarkAsSet(const Tasks& tasks) noexcept;

/// The loops among `tasks`, by the dependencies between them alone: none of a loop feeds one of a
/// loop that comes earlier. O(tasks + dependencies).
/// Source: Tarjan, "Depth-first search and linear graph algorithms" (1972).
[[nodiscard]] std::vector<Tasks> FindLoops(const Tasks& tasks);

/// Where a loop is entered, and what is cut for it.
struct LoopCut {
  OrderedTask* head;
  Tasks loop;                     ///< the head and those that feed it in turn
  std::vector<Dependency*> cuts;  ///< into the head, from the others
};

inline constexpr int kDeepestLoop = 32;

/// Cuts `loop`, of more than one task, by rule 4 of RunningOrder: in front of the task that rule 3
/// puts first and that waits for no task of its own element; then the loops that are left among the
/// others. A function of the loop alone. O(size of the loop), times how deep loops lie in loops; those
/// that lie deeper than kDeepestLoop are cut wherever a connection leads against the order of rule 3.
[[nodiscard]] std::vector<LoopCut> CutLoop(Tasks loop);

}  // namespace runnel::internal

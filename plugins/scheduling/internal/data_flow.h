#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "core/module/executable.h"
#include "core/port/port.h"

namespace runnel::internal {

/// One connection, seen from the tasks at its ends (indices into the list of tasks).
struct DataEdge {
  std::size_t from;
  std::size_t to;
  const Port* from_port;
  const Port* to_port;
};

/// Calls `visit` for every port at or below `group`, in the order of their creation.
void VisitPorts(const FrameworkElement& group, const std::function<void(Port&)>& visit);

/// All connections from what a task writes to what a task reads, in the order of the tasks and
/// their ports. Under the structure lock.
[[nodiscard]] std::vector<DataEdge> FindDataEdges(const std::vector<Task>& tasks);

}  // namespace runnel::internal

#pragma once

#include <vector>

#include "core/base/error.h"
#include "plugins/scheduling/internal/running_order.h"

namespace runnel::internal {

/// Adds a warning for each connection that `order` does not follow; each names both ports.
void ReportCuts(const RunningOrder& order, std::vector<Error>& warnings);

}  // namespace runnel::internal

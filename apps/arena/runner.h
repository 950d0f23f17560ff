#pragma once

#include <functional>
#include <vector>

#include "apps/arena/arguments.h"
#include "apps/arena/matrix.h"
#include "core/base/result.h"

namespace runnel::arena {

/// Called one at a time; `finished` by threads of the runs.
struct RunCallbacks {
  std::function<Result<void>(const PlannedRun&, const RunRecord&)> finished;
  std::function<void()> tick;        ///< a few times a second
  std::function<bool()> is_to_stop;  ///< then those that run are ended, and not told of
};

/// Makes the runs, several at a time, each the product's program in a process of its own. They begin in
/// this order, but end in another. Errors: no process can be started, a temporary file cannot be
/// written, or what `finished` says; the runs that are under way are ended.
Result<void> MakeRuns(const std::vector<const PlannedRun*>& runs, const ArenaArguments& arguments,
                      const Product& product, const Matrix& matrix, const RunCallbacks& callbacks);

}  // namespace runnel::arena

#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/arena/arguments.h"
#include "apps/arena/course.h"
#include "apps/arena/names.h"
#include "apps/arena/run_record.h"
#include "core/base/result.h"

namespace runnel::arena {

/// One run to be made.
struct PlannedRun {
  RunKey key;
  std::size_t course = 0;   ///< which of the matrix
  std::string application;  ///< XML
  std::string made_of;      ///< changes whenever world or application do
};

/// All that is to be run: every world with every variant, sensor, direction and seed.
struct Matrix {
  std::vector<Course> courses;
  std::vector<Variant> variants;
  std::vector<PlannedRun> runs;
};

/// Errors are added, all at once: worlds, variants, sensors, directions that there are not, with
/// the nearest names that there are; two worlds of one name.
[[nodiscard]] std::optional<Matrix> MakeMatrix(const ArenaArguments& arguments, const Product& product,
                                               Diagnostics& diagnostics);

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

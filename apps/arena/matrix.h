#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/arena/arguments.h"
#include "apps/arena/course.h"
#include "apps/arena/names.h"
#include "apps/arena/run_record.h"

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

}  // namespace runnel::arena

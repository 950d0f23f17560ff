#pragma once

#include <filesystem>

#include "apps/arena/course.h"
#include "apps/arena/run_record.h"
#include "core/base/result.h"

namespace runnel::arena {

/// Draws the run as the referee does, into <folder>/<world>-<variant>-<sensor>-<direction>-<seed>.svg. Errors: it cannot be written.
Result<void> WritePicture(const std::filesystem::path& folder, const Course& course,
                          const RunRecord& record);

}  // namespace runnel::arena

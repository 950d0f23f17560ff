#pragma once

#include <filesystem>
#include <string>

#include "apps/arena/course.h"
#include "apps/arena/run_record.h"
#include "core/base/result.h"

namespace runnel::arena {

/// The run as a complete SVG file, drawn as the referee draws.
[[nodiscard]] std::string PictureOf(const Course& course, const RunRecord& record);

/// Into <folder>/<world>-<variant>-<sensor>-<direction>-<seed>.svg. Errors: it cannot be written.
Result<void> WritePicture(const std::filesystem::path& folder, const Course& course,
                          const RunRecord& record);

}  // namespace runnel::arena

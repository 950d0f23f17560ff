#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/arena/names.h"
#include "core/base/result.h"

namespace runnel::arena {

/// The application of a sensor with another planner in the place of the one that stands in it, and
/// with the plugins loaded that the planner may be from. Errors: the file cannot be read, or has
/// not exactly one place for the planner and for plugins.
[[nodiscard]] Result<std::string> ApplicationText(const std::filesystem::path& file, const Variant& variant,
                                                  const std::vector<std::string>& plugins);

/// What is in the file. Errors: it cannot be read.
[[nodiscard]] Result<std::string> ReadFile(const std::filesystem::path& file);
/// Replaces it whole or, on an error, not at all: by way of a file beside it.
Result<void> WriteFile(const std::filesystem::path& file, std::string_view text);

}  // namespace runnel::arena

#pragma once

#include <string>

#include "core/base/result.h"

namespace runnel {

/// Where a viewer may have the application saved: into files called *.xml in the folder of the file that it
/// came from, and in folders below that. `wanted` may be seen from there; links are followed before they are
/// looked at. If it came from no file, a name without a folder will do.
/// Errors: another place; the hint says which are allowed.
[[nodiscard]] Result<std::string> SavePlace(const std::string& application_file, const std::string& wanted);

}  // namespace runnel

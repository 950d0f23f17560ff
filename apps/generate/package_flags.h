#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"

namespace runnel {

/// The -I and -D that pkg-config knows for "PACKAGE" or "PACKAGE >= 1.0". Errors: there is no such package, or no
/// pkg-config.
[[nodiscard]] Result<std::vector<std::string>> FlagsOfPackage(const std::string& package);

}  // namespace runnel

#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"

namespace runnel::program {

/// Returns if `libraries` have been in this process from its start. Else starts the program anew in this process, with
/// the same words and with the libraries. Errors: one of them is not there, or the system's words.
[[nodiscard]] Result<void> PreloadAll(const std::vector<std::string>& libraries);

}  // namespace runnel::program

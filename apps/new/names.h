#pragma once

#include <string>

#include "core/base/result.h"

namespace runnel::new_program {

/// Whether something can be called so, in files, in C++ and in paths: "wall_follower". Errors: why not, and a name
/// that would do.
[[nodiscard]] Result<void> CheckName(const std::string& name);

/// "WallFollower" of "wall_follower". Precondition: CheckName() has no objection.
[[nodiscard]] std::string ClassName(const std::string& name);

}  // namespace runnel::new_program

#pragma once

#include <functional>
#include <string>

#include "apps/runnel/workplace.h"

namespace runnel::program {

/// What `runnel save` has the running program do: saves the application called `name` to the file, or,
/// if that is "", to the one it came from; returns what is to be said of it. Both must outlive it.
[[nodiscard]] std::function<Result<std::string>(const std::string& file)> SaveHook(
    Workplace& workplace, std::string name);

}  // namespace runnel::program

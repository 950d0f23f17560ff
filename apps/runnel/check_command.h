#pragma once

#include "apps/runnel/command_line.h"

namespace runnel::program {

/// Builds the application, runs nothing, and says what is wrong with it.
[[nodiscard]] ExitCode Check(const CheckArguments& arguments);

}  // namespace runnel::program

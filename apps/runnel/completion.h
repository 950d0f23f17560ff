#pragma once

#include "apps/runnel/control_command.h"

namespace runnel::program {

/// Writes what could stand in place of the last of `words`, one a line: paths, types and threads of a
/// running application. For the completion of shells, so it says nothing where it knows nothing.
[[nodiscard]] ExitCode Complete(const ControlArguments& arguments);

}  // namespace runnel::program

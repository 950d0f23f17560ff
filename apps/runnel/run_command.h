#pragma once

#include "apps/runnel/command_line.h"

namespace runnel::program {

/// Builds the application and runs it until its monitors have come to a verdict, its time is up, a
/// fault stops it, or the user does. Progress and verdict go to stdout, all that is wrong to
/// stderr.
[[nodiscard]] ExitCode Run(const RunArguments& arguments);

}  // namespace runnel::program

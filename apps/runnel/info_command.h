#pragma once

#include "apps/runnel/command_line.h"

namespace runnel::program {

/// Says what is in a recording: for persons, or as JSON. A recording that is broken, or was never
/// finished, is shown as far as it goes; what is wrong with it goes to stderr.
[[nodiscard]] ExitCode ShowRecording(const InfoArguments& arguments);

}  // namespace runnel::program

#pragma once

#include "apps/runnel/command_line.h"

namespace runnel::program {

/// Writes the XML schema of application files with the words and types of the plugins.
[[nodiscard]] ExitCode WriteSchema(const SchemaArguments& arguments);

}  // namespace runnel::program

#pragma once

#include "apps/runnel/command_line.h"

namespace runnel::program {

/// Lists the module types of plugins on stdout.
[[nodiscard]] ExitCode ListModules(const ModulesArguments& arguments);

}  // namespace runnel::program

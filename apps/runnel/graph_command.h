#pragma once

#include "apps/runnel/command_line.h"

namespace runnel::program {

/// Draws the data flow of an application that is built and not run. SVG, PNG and PDF need the
/// program `dot` of Graphviz.
[[nodiscard]] ExitCode DrawGraph(const GraphArguments& arguments);

}  // namespace runnel::program

#pragma once

#include <string>

#include "plugins/application_files/application_builder.h"

namespace runnel {

/// Makes ports for all that a recording has, with the paths that were recorded, so that it can be replayed
/// without the application that it is of: `echo`, viewers and recorders find them. Types come from the
/// plugins that can be found; what is of none of them is left out, with a warning. As BuildApplication() with
/// kConstruct.
///
/// Errors: no recording; none of its types is known.
[[nodiscard]] BuildOutcome BuildRecordedPorts(const std::string& file, const BuildTools& tools);

}  // namespace runnel

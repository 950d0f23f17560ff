#pragma once

#include <string>
#include <vector>

#include "plugins/application/application_description.h"

namespace runnel::program {

/// Loads the plugins, or all that can be found if none is named. False after saying which could not
/// be loaded, and why; the others have been.
[[nodiscard]] bool LoadChosenPlugins(const std::vector<std::string>& chosen,
                                     ApplicationDescription& surroundings);

}  // namespace runnel::program

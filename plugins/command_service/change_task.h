#pragma once

#include <memory>

#include "plugins/command_service/command_service.h"

namespace runnel {

/// A change set on its way through the worker: applied at the first step; at the following ones new
/// modules that have taken the place of others are looked after until they have proved themselves. Fills
/// the answer in. The application outlives it.
[[nodiscard]] TaskStep ChangeSteps(ChangeRequest request, const ServedApplication& application,
                                   std::shared_ptr<CommandAnswer> answer);

/// The same for modules that are made anew: the one at the path, or those at or below it that faults have stopped.
[[nodiscard]] TaskStep RestartSteps(std::string path, const ServedApplication& application,
                                    std::shared_ptr<CommandAnswer> answer);

/// The same for what is logged at and below a path.
[[nodiscard]] TaskStep LogLevelSteps(const LogLevelRequest& request, const ServedApplication& application,
                                     std::shared_ptr<CommandAnswer> answer);

}  // namespace runnel

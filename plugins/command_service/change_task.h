#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "plugins/command_service/command_service.h"

namespace runnel {

/// A change set on its way through the worker: applied at the first step; at the following ones new
/// modules that have taken the place of others are looked after until they have proved themselves. Fills
/// the answer in. The application outlives it. `as_of`: see CommandService::Begin(). `made_anew`: instead of changes, the module
/// of this path, or those below it that faults have stopped.
[[nodiscard]] TaskStep ChangeSteps(ChangeRequest request, const ServedApplication& application,
                                   std::shared_ptr<CommandAnswer> answer, const RobotStop::AsOf& as_of,
                                   std::string made_anew = {});

/// Configurable::Outcome() of a parameter that has been set. Locks the structure.
[[nodiscard]] std::optional<Result<void>> OutcomeOf(Runtime& runtime, std::string_view path);
/// How long who has set one waits for that at most.
inline constexpr Duration kLongestSetting = std::chrono::milliseconds(500);

}  // namespace runnel

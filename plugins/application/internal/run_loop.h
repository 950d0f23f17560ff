#pragma once

#include <functional>
#include <optional>

#include "core/base/clock.h"
#include "core/base/result.h"
#include "plugins/scheduling/scheduler.h"

namespace runnel::internal {

/// How often a program looks at an application that runs.
inline constexpr Duration kLookAround = std::chrono::milliseconds(20);

/// How long real threads go on after a stop has been requested, by a fault or by the user, so that
/// what else is there can bring the robot to rest.
inline constexpr Duration kGraceTime = std::chrono::milliseconds(500);

/// Lets a scheduler run until something ends it.
struct RunLoop {
  Scheduler& scheduler;
  Runtime& runtime;
  std::optional<Duration> limit;  ///< on the application's clock
  /// Asked after each simulated cycle, and some fifty times a real second while none runs.
  std::function<bool(Duration so_far)> is_over;
};

/// How long it has run on the application's clock. Afterwards no cycle runs any more. Simulated
/// cycles that are due at the limit do not run.
/// Errors: there is nothing to run.
[[nodiscard]] Result<Duration> Run(const RunLoop& loop);

/// "there is nothing to run", and why.
[[nodiscard]] Error NothingToRun();

}  // namespace runnel::internal

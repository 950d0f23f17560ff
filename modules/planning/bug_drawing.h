#pragma once

#include "modules/planning/algorithm/bug_state.h"
#include "modules/types/algorithm/drawing.h"
#include "modules/types/algorithm/pose.h"
#include "modules/types/algorithm/surroundings.h"

namespace runnel {

/// What a planner of the Bug family has in mind, in the world's frame: the line to the goal, the boundary as it knows
/// it from `pose`, the nearest point of the boundary to the goal, and the way to its leave point. Allocates.
[[nodiscard]] Drawing DrawBugState(const BugState& state, const Pose2& pose,
                                   const Surroundings& surroundings);

}  // namespace runnel

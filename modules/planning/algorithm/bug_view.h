#pragma once

#include "modules/planning/algorithm/bug_configuration.h"
#include "modules/planning/algorithm/bug_state.h"

namespace runnel {

/// What a component of a Bug algorithm looks at when it is asked something: what is so now, and what
/// is remembered. Refers to what the caller owns; not to be kept.
struct BugView {
  const BugConfiguration& configuration;
  const BugState& state;
  const BugInput& input;
};

/// m from the robot to the goal.
[[nodiscard]] double DistanceToGoal(const BugView& view);
/// rad, of a point of the world in the body's frame.
[[nodiscard]] double BearingTo(const BugInput& input, Point2 point);

/// m, the radius of the disc that has to pass: as wide as the clearance at this very place allows,
/// since narrower would call a way free that runs into the boundary followed, and wider would call
/// the tangent blocked.
[[nodiscard]] double PassingRadius(const BugView& view);

/// m, how far the robot sees a way to be free or not: the sensors' range, and if they only feel,
/// what a robot knows by having been there.
[[nodiscard]] double ViewRange(const BugView& view);

/// F of DistBug: m of the straight way to the goal that are free, at most the view range.
[[nodiscard]] double FreeRangeTowardsGoal(const BugView& view);

/// Whether the straight way to the goal is free for at least the leave range, or to the goal.
[[nodiscard]] bool IsFreeTowardsGoal(const BugView& view);

}  // namespace runnel

#pragma once

#include <algorithm>

#include "modules/planning/algorithm/bug_state.h"
#include "modules/planning/algorithm/driving.h"

namespace runnel {

struct BugConfiguration {
  DrivingConfiguration driving;
  /// Where a variant alternates: at its first obstacle; where it turns the shorter way: if both are
  /// the same.
  BoundaryDirection first_direction = BoundaryDirection::kLeft;
  double goal_tolerance = 0.10;  ///< m; nearer than this is there
  /// m by which a leave point must be nearer to the goal than what it is compared with: above the
  /// noise of localisation.
  double leave_margin = 0.10;
  double step = 0.50;         ///< m; STEP of DistBug: by which it must see that it gets nearer
  double hit_range = 0.05;    ///< m; the way to the goal free for less than this is a hit
  double leave_range = 0.10;  ///< m; a leave point must be free towards the goal for this
  /// s; without getting on for so long, and for two turns and a half, there is no room to move;
  /// twice that where sensors are vague.
  double idle_limit = 15.0;
};

/// What a component of a Bug algorithm looks at when it is asked something: what is so now, and what
/// is remembered. Refers to what the caller owns; not to be kept.
struct BugView {
  const BugConfiguration& configuration;
  const BugState& state;
  const BugInput& input;
};

/// m from the robot to the goal.
[[nodiscard]] inline double DistanceToGoal(const BugView& view) {
  return Distance(Position(view.input.pose), view.input.goal);
}
/// rad, of a point of the world in the body's frame, from -177 to 183 degrees: what is straight behind is to the left,
/// however the pose wavers.
[[nodiscard]] inline double BearingTo(const BugInput& input, Point2 point) {
  const double bearing = Direction(ToBody(input.pose, point));
  return bearing < DegreesToRadians(-177.0) ? bearing + 2.0 * kPi : bearing;
}

/// m, the radius of the disc that has to pass: as wide as the clearance at this very place allows,
/// since narrower would call a way free that runs into the boundary followed, and wider would call
/// the tangent blocked.
[[nodiscard]] inline double PassingRadius(const BugView& view) {
  constexpr double kClearanceNoise = 0.02;  // m, of the distance to a boundary followed
  const Surroundings& surroundings = view.input.surroundings;
  const double narrowest = TravelRadius(view.configuration.driving, surroundings);
  return std::clamp(NearestBoundary(surroundings).distance - kClearanceNoise, narrowest,
                    double{surroundings.safe_distance});
}

/// m, how far the robot sees a way to be free or not: the sensors' range, and if they only feel,
/// what a robot knows by having been there.
[[nodiscard]] inline double ViewRange(const BugView& view) {
  return std::max(double{view.input.surroundings.sensor_range},
                  view.configuration.leave_range + view.configuration.leave_margin);
}

/// F of DistBug: m of the straight way to the goal that are free, at most the view range.
[[nodiscard]] inline double FreeRangeTowardsGoal(const BugView& view) {
  const double free = FreeRange(view.input.surroundings, BearingTo(view.input, view.input.goal), PassingRadius(view));
  return std::min(free, ViewRange(view));
}

/// Whether the straight way to the goal is free for at least the leave range, or to the goal.
[[nodiscard]] inline bool IsFreeTowardsGoal(const BugView& view) {
  return FreeRange(view.input.surroundings, BearingTo(view.input, view.input.goal), PassingRadius(view)) >=
         std::min(view.configuration.leave_range, DistanceToGoal(view));
}

}  // namespace runnel

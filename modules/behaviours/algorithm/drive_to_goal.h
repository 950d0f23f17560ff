#pragma once

#include "modules/behaviours/algorithm/steering.h"

namespace runnel {

/// What a behaviour of the robot wants, and how much.
struct Wish {
  Twist2 twist = {};
  double rating = 0.0;  ///< within [0, 1]; 0: it is content
};

struct DriveToGoalConfiguration {
  double tolerance = 0.1;     ///< m; nearer than this it is content
  double far_distance = 1.0;  ///< m; from here on it is as far from content as can be
};

/// Straight to the goal, whatever is in the way.
[[nodiscard]] Wish DriveToGoal(const SteeringConfiguration& steering, const DriveToGoalConfiguration& configuration,
                               const Pose2& pose, Point2 goal);

}  // namespace runnel

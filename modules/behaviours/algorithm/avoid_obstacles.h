#pragma once

#include "modules/behaviours/algorithm/drive_to_goal.h"

namespace runnel {

struct AvoidObstaclesConfiguration {
  double near_distance = 0.8;    ///< m; what is nearer disturbs it, and at the safe distance as much as can be
  double view_half_width = 1.3;  ///< rad, to both sides of the way ahead
};

/// Turns away from the nearest obstacle ahead, and drives the slower the nearer it is.
[[nodiscard]] Wish AvoidObstacles(const SteeringConfiguration& steering, const AvoidObstaclesConfiguration& configuration,
                                  const Surroundings& surroundings);

}  // namespace runnel

#pragma once

#include "modules/types/algorithm/pose.h"
#include "modules/types/algorithm/surroundings.h"

namespace runnel {

/// How the behaviours of a robot drive.
struct SteeringConfiguration {
  double speed = 0.4;            ///< m/s, at most
  double turn_limit = 1.2;       ///< rad/s
  double turn_gain = 3.0;        ///< rad/s of turn for each rad of bearing
  double braking = 0.3;          ///< m/s^2
  double turning_bearing = 0.8;  ///< rad; towards bearings beyond this it turns on the spot
};

/// Towards `bearing` (rad, body's frame), the slower the more it has to turn and the nearer the end of the way is, `free` m
/// ahead.
[[nodiscard]] Twist2 Steer(const SteeringConfiguration& configuration, double bearing, double free);

/// m; the radius of the disc that has to pass: a little less than the safe distance, so that driving along a wall is
/// possible at all.
[[nodiscard]] double PassingRadius(const Surroundings& surroundings);

}  // namespace runnel

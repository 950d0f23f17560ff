#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "modules/types/algorithm/pose.h"
#include "modules/types/algorithm/surroundings.h"

namespace runnel {

/// Which way a robot turns when it meets an obstacle, and so on which hand it keeps the boundary
/// while it follows it: after turning left the boundary is on the right.
enum class BoundaryDirection : std::uint8_t { kLeft, kRight };

[[nodiscard]] constexpr BoundaryDirection Opposite(BoundaryDirection direction) {
  return direction == BoundaryDirection::kLeft ? BoundaryDirection::kRight : BoundaryDirection::kLeft;
}
/// +1 if the robot turned left, -1 if it turned right: a factor that mirrors bearings so that the
/// boundary is always on the right.
[[nodiscard]] constexpr double MirrorSign(BoundaryDirection direction) {
  return direction == BoundaryDirection::kLeft ? 1.0 : -1.0;
}

/// How a planner drives. The accelerations of the body are limited further down; `braking` only
/// says how early to slow down.
struct DrivingConfiguration {
  double cruise_speed = 0.4;     ///< m/s towards the goal
  double following_speed = 0.3;  ///< m/s along a boundary
  double turn_limit = 1.2;       ///< rad/s
  double turn_gain = 3.0;        ///< rad/s of turn for each rad of bearing
  double braking = 0.3;          ///< m/s^2
  double turning_bearing = 0.8;  ///< rad; towards bearings beyond this the robot turns on the spot
  /// m; by so much less than the safe distance the way may be wide, so that small errors of
  /// following do not make the boundary just followed an obstacle.
  double width_tolerance = 0.05;
};

/// m, the radius of the disc that has to pass where the robot drives.
[[nodiscard]] inline double TravelRadius(const DrivingConfiguration& configuration, const Surroundings& surroundings) {
  return double{surroundings.safe_distance} - configuration.width_tolerance;
}

/// Turns on the spot towards `bearing` (rad, body's frame; beyond +-pi it chooses the way round).
[[nodiscard]] inline Twist2 TurnTowards(const DrivingConfiguration& configuration, double bearing) {
  return {0.0, std::clamp(configuration.turn_gain * bearing, -configuration.turn_limit, configuration.turn_limit)};
}

/// m/s, from which the robot stops within `distance` m.
[[nodiscard]] inline double SpeedToStopWithin(const DrivingConfiguration& configuration, double distance) {
  return std::sqrt(2.0 * configuration.braking * std::max(0.0, distance));
}

/// Drives towards `bearing` at up to `speed` m/s, the slower the more it has to turn and the nearer
/// the end of the free way ahead is.
[[nodiscard]] inline Twist2 DriveTowards(const DrivingConfiguration& configuration, const Surroundings& surroundings,
                                         double bearing, double speed) {
  constexpr double kNearly = DegreesToRadians(5.0);
  Twist2 twist = TurnTowards(configuration, bearing);
  const double part = 1.0 - std::abs(bearing) / configuration.turning_bearing;
  if (part <= 0.0) return twist;
  const double radius = TravelRadius(configuration, surroundings);
  double free = FreeRange(surroundings, 0.0, radius);
  // Beside a wall the only free way may be a narrow one: nearly there is there.
  if (std::abs(bearing) < kNearly) free = std::max(free, FreeRange(surroundings, bearing, radius));
  twist.forward = std::min(speed * part, SpeedToStopWithin(configuration, free));
  return twist;
}

}  // namespace runnel

#include "modules/planning/algorithm/driving.h"

#include <algorithm>
#include <cmath>

namespace runnel {

namespace {

constexpr double kNearly = DegreesToRadians(5.0);

}  // namespace

double TravelRadius(const DrivingConfiguration& configuration, const Surroundings& surroundings) {
  return double{surroundings.safe_distance} - configuration.width_tolerance;
}

Twist2 TurnTowards(const DrivingConfiguration& configuration, double bearing) {
  return {0.0, std::clamp(configuration.turn_gain * bearing, -configuration.turn_limit, configuration.turn_limit)};
}

Twist2 DriveTowards(const DrivingConfiguration& configuration, const Surroundings& surroundings, double bearing,
                    double speed) {
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

double SpeedToStopWithin(const DrivingConfiguration& configuration, double distance) {
  return std::sqrt(2.0 * configuration.braking * std::max(0.0, distance));
}

}  // namespace runnel

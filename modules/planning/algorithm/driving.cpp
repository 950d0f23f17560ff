#include "modules/planning/algorithm/driving.h"

#include <algorithm>
#include <cmath>

namespace runnel {

double TravelRadius(const DrivingConfiguration& configuration, const Surroundings& surroundings) {
  return double{surroundings.safe_distance} - configuration.width_tolerance;
}

Twist2 TurnTowards(const DrivingConfiguration& configuration, double bearing) {
  return {0.0, std::clamp(configuration.turn_gain * bearing, -configuration.turn_limit,
                          configuration.turn_limit)};
}

Twist2 DriveTowards(const DrivingConfiguration& configuration, const Surroundings& surroundings,
                    double bearing, double speed) {
  Twist2 twist = TurnTowards(configuration, bearing);
  const double part = 1.0 - std::abs(bearing) / configuration.turning_bearing;
  if (part <= 0.0) return twist;
  const double free = FreeRange(surroundings, 0.0, TravelRadius(configuration, surroundings));
  twist.forward = std::min(speed * part, SpeedToStopWithin(configuration, free));
  return twist;
}

double SpeedToStopWithin(const DrivingConfiguration& configuration, double distance) {
  return std::sqrt(2.0 * configuration.braking * std::max(0.0, distance));
}

}  // namespace runnel

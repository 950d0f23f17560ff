#include "modules/behaviours/algorithm/steering.h"

#include <algorithm>
#include <cmath>

namespace runnel {

namespace {
constexpr double kWidthTolerance = 0.05;  // m
}  // namespace

Twist2 Steer(const SteeringConfiguration& configuration, double bearing, double free) {
  const double turn = std::clamp(configuration.turn_gain * bearing, -configuration.turn_limit, configuration.turn_limit);
  const double part = std::max(0.0, 1.0 - std::abs(bearing) / configuration.turning_bearing);
  const double stopping_speed = std::sqrt(2.0 * configuration.braking * std::max(0.0, free));
  return {std::min(configuration.speed * part, stopping_speed), turn};
}

double PassingRadius(const Surroundings& surroundings) {
  return std::max(0.0, double{surroundings.safe_distance} - kWidthTolerance);
}

}  // namespace runnel

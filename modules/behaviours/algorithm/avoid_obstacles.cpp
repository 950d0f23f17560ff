#include "modules/behaviours/algorithm/avoid_obstacles.h"

#include <algorithm>
#include <cmath>

namespace runnel {

namespace {

constexpr double kStraightAhead = 0.1;  // rad
constexpr double kSideways = 1.0;       // rad, where it looks which side is freer

// +1: to the left.
double FreerSide(const Surroundings& surroundings) {
  const double radius = PassingRadius(surroundings);
  return FreeRange(surroundings, kSideways, radius) >= FreeRange(surroundings, -kSideways, radius) ? 1.0 : -1.0;
}

}  // namespace

Wish AvoidObstacles(const SteeringConfiguration& steering, const AvoidObstaclesConfiguration& configuration,
                    const Surroundings& surroundings) {
  const BoundaryPoint nearest = NearestBoundary(surroundings, 0.0, configuration.view_half_width);
  const double safe = surroundings.safe_distance;
  const double room = std::max(configuration.near_distance - safe, 1e-3);
  const double nearness = std::clamp((safe + room - nearest.distance) / room, 0.0, 1.0);
  if (nearness <= 0.0) return {};
  const bool is_ahead = std::abs(nearest.bearing) < kStraightAhead;
  const double away = is_ahead ? FreerSide(surroundings) : (nearest.bearing > 0.0 ? -1.0 : 1.0);
  return {{steering.speed * (1.0 - nearness), away * steering.turn_limit}, nearness};
}

}  // namespace runnel

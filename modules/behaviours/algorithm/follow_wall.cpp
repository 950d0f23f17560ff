#include "modules/behaviours/algorithm/follow_wall.h"

#include <algorithm>
#include <cmath>

namespace runnel {

namespace {

// rad, as if the wall were on the right: where that is looked for.
constexpr double kHandMiddle = -1.05;
constexpr double kHandHalfWidth = 1.75;
constexpr double kBeside = 1.0;  // m; what is further away is not beside it
constexpr double kLookStep = 0.05;  // rad

// Where the wall is, as if that were on the right; the nearest one if none is on that hand.
double WallBearing(const Surroundings& surroundings, double hand) {
  const BoundaryPoint on_hand = NearestBoundary(surroundings, hand * kHandMiddle, kHandHalfWidth);
  if (on_hand.distance <= kBeside) return hand * on_hand.bearing;
  return hand * NearestBoundary(surroundings).bearing;
}

}  // namespace

Wish FollowWall(const SteeringConfiguration& steering, const FollowWallConfiguration& configuration,
                const Surroundings& surroundings) {
  const double hand = configuration.first_turn == FirstTurn::kLeft ? 1.0 : -1.0;  // +1: the wall is on the right
  const double radius = PassingRadius(surroundings);
  const double wall = WallBearing(surroundings, hand);
  double bearing = hand * kPi;  // nowhere: it turns round
  for (double look = wall; look < wall + 2 * kPi; look += kLookStep) {
    if (FreeRange(surroundings, hand * look, radius) < configuration.look_ahead) continue;
    bearing = WrapAngle(hand * look);
    break;
  }
  const double ahead = FreeRange(surroundings, 0.0, radius);
  const double beside = NearestBoundary(surroundings, -hand * kPi / 2, kPi / 2).distance;
  const double error = std::abs(beside - radius) / std::max(radius, 1e-3);
  return {Steer(steering, bearing, ahead), std::min(1.0, error)};
}

}  // namespace runnel

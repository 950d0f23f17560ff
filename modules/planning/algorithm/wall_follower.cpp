#include "modules/planning/algorithm/wall_follower.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace runnel {

namespace {

// With the boundary on the right, it is looked for from nearly behind to left of ahead:
// a wall of a concave corner ahead belongs to it, the other wall of a corridor does not.
constexpr double kHandCentre = DegreesToRadians(-65.0);
constexpr double kHandHalfWidth = DegreesToRadians(110.0);
constexpr double kDistanceGain = 6.0;                        // rad of bearing for each m of error
constexpr double kCorrectionLimit = DegreesToRadians(60.0);  // so that far off it still advances
constexpr double kCautiousLookahead = 0.40;  // m, where the robot turned away just before
constexpr double kCautiousReach = 0.25;      // m from there
constexpr double kLeastLookahead = 0.03;     // m, in a tight place
constexpr double kLookahead = 0.15;          // m that the way must be free
constexpr double kSqueeze = DegreesToRadians(30.0);
constexpr double kSweepStep = DegreesToRadians(3.0);
constexpr double kTurnedEnough = DegreesToRadians(10.0);
constexpr double kOvershoot = DegreesToRadians(30.0);  // of a turn, before it counts as a whole one
constexpr double kLargeTurn = DegreesToRadians(60.0);
constexpr double kSearchRadius = 0.5;  // m, of the circle towards a lost boundary

// Rad, mirrored so that the boundary is on the right, not wrapped: the robot turns away from the
// boundary even if it has to turn by more than half a circle.
std::optional<double> FreeBearing(const Surroundings& surroundings, double sign, double radius,
                                  double tangent, double lookahead) {
  const auto is_free = [&](double bearing) {
    return FreeRange(surroundings, sign * bearing, radius) >= lookahead;
  };
  // In a narrow passage nearer to the boundary than it likes to be, so that whether a passage is
  // wide enough does not depend on the side the robot comes from.
  for (double bearing = tangent; bearing > tangent - kSqueeze; bearing -= kSweepStep) {
    if (is_free(bearing)) return bearing;
  }
  for (double bearing = tangent; bearing < tangent + 2 * kPi; bearing += kSweepStep) {
    if (is_free(bearing)) return bearing;
  }
  return std::nullopt;
}

double BearingToGo(const Surroundings& surroundings, double sign, double radius,
                   const BoundaryPoint& contact, double lookahead) {
  const double correction =
      std::clamp(kDistanceGain * (double{surroundings.safe_distance} - contact.distance),
                 -kCorrectionLimit, kCorrectionLimit);
  const double tangent = sign * contact.bearing + kPi / 2 + correction;
  for (double free = lookahead; free > kLeastLookahead; free /= 2) {
    if (const auto bearing = FreeBearing(surroundings, sign, radius, tangent, free)) {
      return *bearing;
    }
  }
  return kPi;
}

}  // namespace

void WallFollower::Start(BoundaryDirection direction, const Pose2& pose, double contact_bearing) {
  direction_ = direction;
  const double sign = MirrorSign(direction);
  const double offset = sign * WrapAngle(contact_bearing) + kPi / 2;
  is_turning_ = true;
  is_cautious_ = false;
  turn_sign_ = offset >= 0.0 ? sign : -sign;
  target_heading_ = pose.heading + sign * offset;
}

BoundaryPoint WallFollower::Contact(const Surroundings& surroundings) const {
  return NearestBoundary(surroundings, MirrorSign(direction_) * kHandCentre, kHandHalfWidth);
}

Twist2 WallFollower::Update(const DrivingConfiguration& configuration, const Pose2& pose,
                            const Surroundings& surroundings) {
  if (is_turning_) {
    double remaining = WrapAngle(target_heading_ - pose.heading);
    if (turn_sign_ * remaining < -kOvershoot) remaining += turn_sign_ * 2 * kPi;
    if (std::abs(remaining) > kTurnedEnough) return TurnTowards(configuration, remaining);
    is_turning_ = false;
  }
  const double sign = MirrorSign(direction_);
  const BoundaryPoint contact = Contact(surroundings);
  const double speed = configuration.following_speed;
  if (!std::isfinite(contact.distance)) return {speed, -sign * speed / kSearchRadius};
  const double radius = TravelRadius(configuration, surroundings);
  if (is_cautious_ && Distance(turning_place_, Position(pose)) > kCautiousReach) {
    is_cautious_ = false;
  }
  const double lookahead = is_cautious_ ? kCautiousLookahead : kLookahead;
  const double bearing = BearingToGo(surroundings, sign, radius, contact, lookahead);
  // A large turn is finished: half way, a gap just too narrow may look just wide enough.
  if (bearing > kLargeTurn) {
    is_turning_ = true;
    is_cautious_ = true;
    turning_place_ = Position(pose);
    turn_sign_ = sign;
    target_heading_ = pose.heading + sign * bearing;
  }
  return DriveTowards(configuration, surroundings, sign * bearing, speed);
}

}  // namespace runnel

#include "modules/planning/algorithm/wall_follower.h"

#include <algorithm>
#include <cmath>

namespace runnel {

namespace {

// With the boundary on the right, it is looked for from nearly behind to left of ahead:
// a wall of a concave corner ahead belongs to it, the other wall of a corridor does not.
constexpr double kHandRear = DegreesToRadians(-175.0);
constexpr double kHandFront = DegreesToRadians(45.0);
// Of that hand what is no more ahead.
constexpr double kBesideFront = DegreesToRadians(-60.0);
// Of that hand what is always in it, and what lies no further back than this from the boundary followed before.
constexpr double kFirmRear = DegreesToRadians(-110.0);
constexpr double kBackFromContact = DegreesToRadians(90.0);
constexpr double kBesideReach = 0.30;                        // m, beyond the safe distance
constexpr double kDistanceGain = 6.0;                        // rad of bearing for each m of error
constexpr double kCorrectionLimit = DegreesToRadians(60.0);  // so that far off it still advances
constexpr double kCautiousLookahead = 0.40;                  // m, where the robot turned away just before
constexpr double kCautiousReach = 0.25;                      // m from there
constexpr double kLeastLookahead = 0.03;                     // m, in a tight place
constexpr double kLookahead = 0.15;                          // m that the way must be free
constexpr double kSqueeze = DegreesToRadians(30.0);
constexpr double kSweepStep = DegreesToRadians(3.0);
constexpr double kLookedAt = DegreesToRadians(5.0);  // within what counts as faced
constexpr double kTurnedEnough = DegreesToRadians(10.0);
constexpr double kOvershoot = DegreesToRadians(30.0);  // of a turn, before it counts as a whole one
constexpr double kLargeTurn = DegreesToRadians(60.0);
constexpr double kDetour = DegreesToRadians(15.0);            // off the tangent, that is worth a look
constexpr double kAhead = DegreesToRadians(-60.0);            // of the boundary, where it is no more beside
constexpr double kBesideConeFront = DegreesToRadians(-77.0);  // of what the ranger beside looks at
constexpr double kDetached = 0.15;                            // m, further off than the boundary ahead of it
constexpr double kSearchRadius = 0.5;                         // m, of the circle towards a lost boundary

// What the robot sees, mirrored so that the boundary is on the right, and as if it had not turned to
// look round.
class Gaze {
 public:
  // `turned` (rad): by so much the robot has turned to look round.
  Gaze(const Surroundings& surroundings, const FacedHeadings& faced, double sign, double turned, double radius)
      : surroundings_(surroundings), faced_(faced), sign_(sign), turned_(turned), radius_(radius) {}

  [[nodiscard]] double Body(double bearing) const { return sign_ * bearing - turned_; }
  [[nodiscard]] double Mirrored(double body) const { return sign_ * WrapAngle(body + turned_); }

  // Whether a point ahead may not be there: it has not been faced from here. What is beside the robot,
  // the rangers there have looked at.
  [[nodiscard]] bool IsInDoubt(double bearing) const {
    return surroundings_.is_vague && bearing > kAhead && !faced_.Contains(Body(bearing));
  }

  // The same of the boundary followed. Between the cones ahead and beside, the arc of an echo from elsewhere may go on from
  // a boundary that has come to its end, and would lead the robot away from it.
  [[nodiscard]] bool IsInDoubt(const BoundaryPoint& contact, double bearing) const {
    if (IsInDoubt(bearing)) return true;
    if (!surroundings_.is_vague || bearing < kBesideConeFront || faced_.Contains(Body(bearing))) return false;
    const double beside = NearestBoundary(surroundings_, Body(-kPi / 2), kPi / 2 + kBesideConeFront).distance;
    return beside > contact.distance + kDetached;
  }

  // Rad, not wrapped: the robot turns away from the boundary even if it has to turn by more than half
  // a circle.
  [[nodiscard]] double BearingToGo(double tangent, double lookahead) const {
    for (double free = lookahead; free > kLeastLookahead; free /= 2) {
      if (const auto bearing = FreeBearing(tangent, free)) return *bearing;
    }
    return kPi;
  }

  // The first point, if there is one, for which the robot would turn away from the tangent, and that
  // may not be there.
  [[nodiscard]] std::optional<double> Doubt(double tangent, double bearing_to_go, double lookahead) const {
    if (!surroundings_.is_vague || bearing_to_go < tangent + kDetour) return std::nullopt;
    for (double bearing = tangent; bearing < bearing_to_go; bearing += kSweepStep) {
      const WayAhead way = LookAlong(surroundings_, Body(bearing), radius_);
      const double obstacle = Mirrored(way.obstacle_bearing);
      if (way.free_range < lookahead && IsInDoubt(obstacle)) return obstacle;
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] std::optional<double> FreeBearing(double tangent, double lookahead) const {
    const auto is_free = [&](double bearing) { return FreeRange(surroundings_, Body(bearing), radius_) >= lookahead; };
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

  const Surroundings& surroundings_;
  const FacedHeadings& faced_;
  double sign_;
  double turned_;
  double radius_;
};

double Tangent(const Surroundings& surroundings, const BoundaryPoint& contact, double bearing) {
  const double correction = std::clamp(kDistanceGain * (double{surroundings.safe_distance} - contact.distance),
                                       -kCorrectionLimit, kCorrectionLimit);
  return bearing + kPi / 2 + correction;
}

}  // namespace

void WallFollower::Start(BoundaryDirection direction, const Pose2& pose, double contact_bearing) {
  direction_ = direction;
  const double sign = MirrorSign(direction);
  const double offset = sign * WrapAngle(contact_bearing) + kPi / 2;
  is_turning_ = true;
  is_cautious_ = false;
  EndLook();
  last_heading_ = pose.heading;
  contact_bearing_ = contact_bearing;
  turn_sign_ = offset >= 0.0 ? sign : -sign;
  target_heading_ = pose.heading + sign * offset;
}

void WallFollower::EndLook() {
  is_looking_ = false;
  looked_round_ = 0.0;
}

// rad, mirrored, from where on boundary points are on the hand. When the robot has turned towards its boundary, the other
// side of a passage is behind it, and may be nearer.
double WallFollower::HandRear() const {
  if (!contact_bearing_) return kHandRear;
  double before = MirrorSign(direction_) * WrapAngle(*contact_bearing_ + looked_round_);
  if (before > kPi / 2) before -= 2 * kPi;
  return std::max(kHandRear, std::min(kFirmRear, before - kBackFromContact));
}

BoundaryPoint WallFollower::Contact(const Surroundings& surroundings) const {
  const double sign = MirrorSign(direction_);
  const double rear = surroundings.is_vague ? HandRear() : kHandRear;
  const auto nearest = [&](double from, double to) {
    return NearestBoundary(surroundings, sign * (from + to) / 2 - looked_round_, (to - from) / 2);
  };
  if (surroundings.is_vague) {
    // Pushed off its boundary by an arc, the robot may be nearer to the other side of a passage. But what comes nearer
    // from beside it to ahead is one boundary: whether that is beside it must not change with each turn towards it.
    const BoundaryPoint beside = nearest(rear, kBesideFront);
    const int further_ahead = SectorOf(beside.bearing + sign * kSectorWidth);
    if (beside.distance < double{surroundings.safe_distance} + kBesideReach &&
        beside.distance <= ContourDistance(surroundings, further_ahead)) {
      return beside;
    }
  }
  const BoundaryPoint contact = nearest(rear, kHandFront);
  return std::isfinite(contact.distance) ? contact : nearest(kHandRear, kHandFront);
}

std::optional<double> WallFollower::ContactHeading(const Pose2& pose, const Surroundings& surroundings) const {
  if (is_turning_) return target_heading_ - MirrorSign(direction_) * kPi / 2;
  const BoundaryPoint contact = Contact(surroundings);
  if (!std::isfinite(contact.distance)) return std::nullopt;
  return pose.heading + contact.bearing;
}

Twist2 WallFollower::Update(const DrivingConfiguration& configuration, const Pose2& pose,
                            const Surroundings& surroundings, const FacedHeadings& faced) {
  const double turned = WrapAngle(pose.heading - last_heading_);
  last_heading_ = pose.heading;
  if (contact_bearing_) *contact_bearing_ -= turned;
  if (is_turning_) {
    double remaining = WrapAngle(target_heading_ - pose.heading);
    if (turn_sign_ * remaining < -kOvershoot) remaining += turn_sign_ * 2 * kPi;
    if (std::abs(remaining) > kTurnedEnough) return TurnTowards(configuration, remaining);
    is_turning_ = false;
  }
  const double sign = MirrorSign(direction_);
  if (is_looking_) {
    looked_round_ += turned;
    if (std::abs(look_to_ - looked_round_) > kLookedAt) {
      return TurnTowards(configuration, look_to_ - looked_round_);
    }
  }
  const BoundaryPoint contact = Contact(surroundings);
  const double speed = configuration.following_speed;
  if (!std::isfinite(contact.distance)) {
    EndLook();
    contact_bearing_.reset();
    const double searching = std::min(speed, configuration.turn_limit * kSearchRadius);
    return {searching, -sign * searching / kSearchRadius};
  }
  contact_bearing_ = contact.bearing;
  const double radius = TravelRadius(configuration, surroundings);
  if (is_cautious_ && Distance(turning_place_, Position(pose)) > kCautiousReach) {
    is_cautious_ = false;
  }
  const double lookahead = is_cautious_ ? kCautiousLookahead : kLookahead;
  const Gaze gaze(surroundings, faced, sign, looked_round_, radius);
  const double contact_bearing = gaze.Mirrored(contact.bearing);
  const double tangent = Tangent(surroundings, contact, contact_bearing);
  const double bearing = gaze.BearingToGo(tangent, lookahead);
  const auto doubt = gaze.IsInDoubt(contact, contact_bearing) ? std::optional(contact_bearing)
                                                              : gaze.Doubt(tangent, bearing, lookahead);
  if (doubt) {
    is_looking_ = true;
    look_to_ = looked_round_ + gaze.Body(*doubt);
    return TurnTowards(configuration, look_to_ - looked_round_);
  }
  const double remaining = gaze.Body(bearing);
  // A large turn is finished: half way, a gap just too narrow may look just wide enough.
  if (bearing > kLargeTurn || (is_looking_ && std::abs(remaining) > kTurnedEnough)) {
    is_turning_ = true;
    is_cautious_ = is_cautious_ || bearing > kLargeTurn;
    turning_place_ = Position(pose);
    turn_sign_ = remaining > 0.0 ? 1.0 : -1.0;
    target_heading_ = pose.heading + remaining;
  }
  EndLook();
  return DriveTowards(configuration, surroundings, remaining, speed);
}

}  // namespace runnel

#pragma once

#include <optional>

#include "modules/planning/algorithm/driving.h"
#include "modules/planning/algorithm/faced_headings.h"

namespace runnel {

/// Follows the boundary of an obstacle at the safe distance (WALLFOLLOWING(DIRECTION) of the
/// generic Bug algorithm).
///
/// With the boundary on the right: from the nearest boundary point on the right, swing the gaze to
/// the left to the tangent, corrected by the error of distance, and on until the body can go that
/// way. On a straight wall that is the tangent, at a convex corner the tangent of the circle round
/// the corner, in a concave corner or before a narrow gap the first way out to the left. With the
/// boundary on the left everything is mirrored.
///
/// Where the surroundings are vague, it turns away from nothing that it has not faced: what may be in
/// the way is looked at first, one point after the other, and the way is chosen when nothing is in
/// doubt, as seen from the heading before the looks.
class WallFollower {
 public:
  /// Begins to follow the boundary that has a point at `contact_bearing` (rad, body's frame): the
  /// robot first turns on the spot until that point is on its hand, away from the obstacle.
  void Start(BoundaryDirection direction, const Pose2& pose, double contact_bearing);

  /// The twist to drive now; `faced` from the robot's place, up to its pose. Does not allocate.
  [[nodiscard]] Twist2 Update(const DrivingConfiguration& configuration, const Pose2& pose,
                              const Surroundings& surroundings, const FacedHeadings& faced);

  /// The nearest point of the boundary on the robot's hand.
  [[nodiscard]] BoundaryPoint Contact(const Surroundings& surroundings) const;
  /// Rad, in the world: where that point is, or will be once the robot has turned the boundary to its hand. Nothing: it
  /// is lost.
  [[nodiscard]] std::optional<double> ContactHeading(const Pose2& pose, const Surroundings& surroundings) const;
  [[nodiscard]] BoundaryDirection direction() const { return direction_; }
  /// Whether the robot still turns the boundary to its hand.
  [[nodiscard]] bool is_turning() const { return is_turning_; }

 private:
  void EndLook();
  [[nodiscard]] double HandRear() const;

  friend struct KeptFields;  // names the members for a handover
  BoundaryDirection direction_ = BoundaryDirection::kLeft;
  bool is_turning_ = false;
  double target_heading_ = 0.0;  // rad, in the world, while turning
  bool is_cautious_ = false;     // near a place where the way along the boundary was blocked
  Point2 turning_place_;
  double turn_sign_ = 0.0;                 // +1 counter-clockwise
  bool is_looking_ = false;                // round, to face what is vague
  double looked_round_ = 0.0;              // rad that it has turned since it began to
  double look_to_ = 0.0;                   // rad, of it
  double last_heading_ = 0.0;              // rad, in the world
  std::optional<double> contact_bearing_;  // rad, of the boundary followed, seen from the pose of the last update
};

}  // namespace runnel

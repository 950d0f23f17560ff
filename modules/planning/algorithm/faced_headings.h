#pragma once

#include <algorithm>

#include "modules/types/algorithm/angle.h"
#include "modules/types/algorithm/pose.h"

namespace runnel {

/// Which way a robot has looked since it came to where it stands. A ranger of some width tells best
/// where an obstacle is while it faces it: what was faced from here and is still in the way is there.
/// One interval, because a robot turns continuously; it only grows, so that looking comes to an end.
class FacedHeadings {
 public:
  void Start(const Pose2& pose) {
    place_ = Position(pose);
    heading_ = pose.heading;
    left_ = right_ = 0.0;
  }
  void Update(const Pose2& pose) {
    if (Distance(place_, Position(pose)) > kSamePlace) return Start(pose);
    const double turn = WrapAngle(pose.heading - heading_);
    heading_ = pose.heading;
    left_ = std::clamp(left_ - turn, 0.0, 2 * kPi);
    right_ = std::clamp(right_ + turn, 0.0, 2 * kPi);
  }
  /// `bearing` (rad) in the body's frame.
  [[nodiscard]] bool Contains(double bearing) const {
    const double to_left = WrapAngle(bearing) >= 0.0 ? WrapAngle(bearing) : WrapAngle(bearing) + 2 * kPi;
    return to_left <= left_ + kFaced || 2 * kPi - to_left <= right_ + kFaced;
  }

  static constexpr double kFaced = DegreesToRadians(8.0);  ///< rad, of bearing: within every view

 private:
  friend struct KeptFields;                   // names the members for a handover
  static constexpr double kSamePlace = 0.10;  // m
  Point2 place_;
  double heading_ = 0.0;  // rad, in the world
  double left_ = 0.0;     // rad, from there
  double right_ = 0.0;
};

}  // namespace runnel

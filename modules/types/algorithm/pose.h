#pragma once

#include "modules/types/algorithm/point.h"

namespace runnel {

/// Where a body is in the world: metres, and the heading in rad, 0 along x, counter-clockwise.
struct Pose2 {
  double x = 0.0;
  double y = 0.0;
  double heading = 0.0;

  friend constexpr bool operator==(const Pose2&, const Pose2&) = default;
};

[[nodiscard]] inline bool IsFinite(const Pose2& pose) {
  return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.heading);
}
[[nodiscard]] constexpr Point2 Position(const Pose2& pose) { return {pose.x, pose.y}; }

/// The frame of a body (x ahead, y left) in that of its pose. Its sine and cosine are computed once for many points.
class BodyFrame {
 public:
  explicit BodyFrame(const Pose2& pose) : origin_(Position(pose)), ahead_(UnitVector(pose.heading)) {}
  [[nodiscard]] constexpr Point2 ToBody(Point2 world) const {
    const Point2 offset = world - origin_;
    return {Dot(ahead_, offset), Cross(ahead_, offset)};
  }
  [[nodiscard]] constexpr Point2 ToWorld(Point2 local) const {
    return {origin_.x + ahead_.x * local.x - ahead_.y * local.y, origin_.y + ahead_.y * local.x + ahead_.x * local.y};
  }

 private:
  Point2 origin_;
  Point2 ahead_;
};

/// From the body's frame into that of the pose.
[[nodiscard]] inline Point2 ToWorld(const Pose2& pose, Point2 local) { return BodyFrame(pose).ToWorld(local); }
/// The way back: from the frame of the pose into the body's frame.
[[nodiscard]] inline Point2 ToBody(const Pose2& pose, Point2 world) { return BodyFrame(pose).ToBody(world); }

/// How a planar body moves, in its own frame: m/s ahead, rad/s counter-clockwise.
struct Twist2 {
  double forward = 0.0;
  double turn = 0.0;

  friend constexpr bool operator==(const Twist2&, const Twist2&) = default;
};
[[nodiscard]] inline bool IsFinite(const Twist2& twist) {
  return std::isfinite(twist.forward) && std::isfinite(twist.turn);
}

}  // namespace runnel

#pragma once

#include <cmath>
#include <vector>

namespace runnel {

/// A point or a vector in the plane, in m; which frame, its owner says.
struct Point2 {
  double x = 0.0;
  double y = 0.0;

  friend constexpr Point2 operator+(Point2 a, Point2 b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Point2 operator-(Point2 a, Point2 b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Point2 operator*(double factor, Point2 a) { return {factor * a.x, factor * a.y}; }
  friend constexpr bool operator==(Point2, Point2) = default;
};

[[nodiscard]] inline bool IsFinite(Point2 point) { return std::isfinite(point.x) && std::isfinite(point.y); }
[[nodiscard]] constexpr double Dot(Point2 a, Point2 b) { return a.x * b.x + a.y * b.y; }
/// Positive if b lies to the left of a.
[[nodiscard]] constexpr double Cross(Point2 a, Point2 b) { return a.x * b.y - a.y * b.x; }
[[nodiscard]] inline double Norm(Point2 a) { return std::hypot(a.x, a.y); }
[[nodiscard]] inline double Distance(Point2 a, Point2 b) { return Norm(b - a); }
/// The direction of a in rad, 0 along x, counter-clockwise positive; 0 for the zero vector.
[[nodiscard]] inline double Direction(Point2 a) { return std::atan2(a.y, a.x); }
[[nodiscard]] inline Point2 UnitVector(double direction) { return {std::cos(direction), std::sin(direction)}; }
/// The vector turned as far as the unit vector `by` is turned from the x axis.
[[nodiscard]] constexpr Point2 Turned(Point2 vector, Point2 by) {
  return {by.x * vector.x - by.y * vector.y, by.y * vector.x + by.x * vector.y};
}

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

/// How fast the two wheels of a differential drive turn, in rad/s, positive ahead.
struct WheelSpeeds {
  double left = 0.0;
  double right = 0.0;

  friend constexpr bool operator==(const WheelSpeeds&, const WheelSpeeds&) = default;
};
[[nodiscard]] inline bool IsFinite(const WheelSpeeds& speeds) {
  return std::isfinite(speeds.left) && std::isfinite(speeds.right);
}

/// Where something went or is to go, from its begin to its end; m, world.
struct Path2 {
  std::vector<Point2> points;

  friend bool operator==(const Path2&, const Path2&) = default;
};

}  // namespace runnel

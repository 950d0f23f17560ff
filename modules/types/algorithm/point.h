#pragma once

#include <cmath>

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

}  // namespace runnel

#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "modules/types/algorithm/angle.h"
#include "modules/types/algorithm/segment.h"

namespace runnel::internal {

/// The same direction within [0, 2π).
[[nodiscard]] inline double PositiveAngle(double angle) {
  const double positive = std::fmod(angle, 2 * kPi);
  const double wrapped = positive < 0.0 ? positive + 2 * kPi : positive;
  return wrapped < 2 * kPi ? wrapped : 0.0;
}

/// How far it is counter-clockwise from one direction to another, within [0, 2π).
[[nodiscard]] inline double Sweep(double from, double to) { return PositiveAngle(to - from); }

[[nodiscard]] inline double Distance(const Segment2& a, const Segment2& b) {
  if (WhereItMeets(a, b)) return 0.0;
  return std::min(
      {runnel::Distance(a, b.from), runnel::Distance(a, b.to), runnel::Distance(b, a.from), runnel::Distance(b, a.to)});
}

/// Where circle and segment meet: no, one or two points. A tangent counts as one or as two that are
/// nearly equal, if it touches within `tolerance`.
[[nodiscard]] inline std::vector<Point2> Meeting(Point2 centre, double radius, const Segment2& segment,
                                                 double tolerance) {
  const Point2 along = segment.to - segment.from;
  const double length = Norm(along);
  if (length == 0.0) return {};
  const Point2 unit = (1.0 / length) * along;
  const double foot = Dot(centre - segment.from, unit);
  const double away = std::abs(Cross(unit, centre - segment.from));
  if (away > radius + tolerance) return {};
  const double half = std::sqrt(std::max(radius * radius - away * away, 0.0));
  std::vector<Point2> points;
  for (const double at : {foot - half, foot + half}) {
    if (at < -tolerance || at > length + tolerance) continue;
    points.push_back(segment.from + at * unit);
  }
  return points;
}

/// Where two circles meet. Equal circles meet nowhere.
[[nodiscard]] inline std::vector<Point2> Meeting(Point2 centre, double radius, Point2 other_centre, double other_radius,
                                                 double tolerance) {
  const Point2 gap = other_centre - centre;
  const double distance = Norm(gap);
  const bool is_apart = distance > radius + other_radius + tolerance;
  const bool is_within = distance < std::abs(radius - other_radius) - tolerance;
  if (distance <= tolerance || is_apart || is_within) return {};
  const double foot = (distance * distance + radius * radius - other_radius * other_radius) / (2.0 * distance);
  const double half = std::sqrt(std::max(radius * radius - foot * foot, 0.0));
  const Point2 unit = (1.0 / distance) * gap, left{-unit.y, unit.x};
  const Point2 middle = centre + foot * unit;
  return {middle + half * left, middle + -half * left};
}

}  // namespace runnel::internal

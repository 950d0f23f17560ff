#pragma once

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

[[nodiscard]] double Distance(const Segment2& a, const Segment2& b);

/// Where circle and segment meet: no, one or two points. A tangent counts as one or as two that are
/// nearly equal, if it touches within `tolerance`.
[[nodiscard]] std::vector<Point2> Meeting(Point2 centre, double radius, const Segment2& segment, double tolerance);
/// Where two circles meet. Equal circles meet nowhere.
[[nodiscard]] std::vector<Point2> Meeting(Point2 centre, double radius, Point2 other_centre, double other_radius,
                                          double tolerance);

}  // namespace runnel::internal

#pragma once

#include <algorithm>
#include <optional>

#include "modules/types/algorithm/pose.h"

namespace runnel {

struct Segment2 {
  Point2 from;
  Point2 to;

  friend constexpr bool operator==(const Segment2&, const Segment2&) = default;
};

/// The point of the segment nearest to `point`. A segment of no length is its one point.
[[nodiscard]] constexpr Point2 NearestPoint(const Segment2& segment, Point2 point) {
  const Point2 along = segment.to - segment.from;
  const double length_squared = Dot(along, along);
  if (length_squared == 0.0) return segment.from;
  const double part = std::clamp(Dot(point - segment.from, along) / length_squared, 0.0, 1.0);
  return segment.from + part * along;
}

[[nodiscard]] inline double Distance(const Segment2& segment, Point2 point) {
  return Distance(NearestPoint(segment, point), point);
}

/// How far along `a`, in parts of its length from 0 to 1, it meets `b`; nothing if they do not
/// meet. Parallel segments never meet by this function, even if they overlap.
[[nodiscard]] constexpr std::optional<double> WhereItMeets(const Segment2& a, const Segment2& b) {
  const Point2 along_a = a.to - a.from, along_b = b.to - b.from, gap = b.from - a.from;
  const double denominator = Cross(along_a, along_b);
  if (denominator == 0.0) return std::nullopt;
  const double on_a = Cross(gap, along_b) / denominator;
  const double on_b = Cross(gap, along_a) / denominator;
  if (on_a < 0.0 || on_a > 1.0 || on_b < 0.0 || on_b > 1.0) return std::nullopt;
  return on_a;
}

}  // namespace runnel

#pragma once

#include <optional>

#include "modules/types/algorithm/segment.h"

namespace runnel {

/// The straight line from the start to the goal on which some variants may leave obstacles.
class MLine {
 public:
  MLine(Point2 start, Point2 goal) : segment_{start, goal} {}

  /// Where the way from `before` to `now` crossed the line. A robot never samples the crossing
  /// itself, so the way between two samples is tested; a way that ends on the line crosses it, one
  /// that starts on it does not, so no crossing counts twice.
  [[nodiscard]] std::optional<Point2> Crossing(Point2 before, Point2 now) const {
    const double side_before = Side(before), side_now = Side(now);
    const bool crosses = (side_before < 0.0 && side_now >= 0.0) || (side_before > 0.0 && side_now <= 0.0);
    if (!crosses) return std::nullopt;
    const double part = side_before / (side_before - side_now);
    const Point2 crossing = before + part * (now - before);
    const Point2 along = segment_.to - segment_.from;
    const double place = Dot(crossing - segment_.from, along);
    if (place < 0.0 || place > Dot(along, along)) return std::nullopt;
    return crossing;
  }

  /// The point of the line `lookahead` m further towards the goal than the one nearest to
  /// `position`: what to steer at so as to come back to the line and stay on it.
  [[nodiscard]] Point2 PointAhead(Point2 position, double lookahead) const {
    const Point2 nearest = NearestPoint(segment_, position);
    const double rest = Distance(nearest, segment_.to);
    if (rest <= lookahead) return segment_.to;
    return nearest + (lookahead / rest) * (segment_.to - nearest);
  }

  /// The point of the line, between start and goal, nearest to `point`.
  [[nodiscard]] Point2 Nearest(Point2 point) const { return NearestPoint(segment_, point); }
  [[nodiscard]] double DistanceTo(Point2 point) const { return Distance(segment_, point); }

 private:
  [[nodiscard]] double Side(Point2 point) const { return Cross(segment_.to - segment_.from, point - segment_.from); }

  Segment2 segment_;
};

}  // namespace runnel

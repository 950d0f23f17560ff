#include "modules/adaptors/algorithm/infrared_adaptor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace runnel {

namespace {

constexpr double kWidest = DegreesToRadians(89.0);  // of half a cone

// A box with sides along the axes round a sector of a circle: the corners of the triangle round the
// sector, but no more than the circle.
std::pair<Point2, Point2> BoxRound(Point2 apex, double heading, double half_width, double radius) {
  const Point2 left = UnitVector(heading + half_width), right = UnitVector(heading - half_width);
  const auto range = [=](double a, double b) {
    const double far = radius / std::cos(half_width);
    return std::pair(std::max(std::min({0.0, far * a, far * b}), -radius),
                     std::min(std::max({0.0, far * a, far * b}), radius));
  };
  const auto [low_x, high_x] = range(left.x, right.x);
  const auto [low_y, high_y] = range(left.y, right.y);
  return {apex + Point2{low_x, low_y}, apex + Point2{high_x, high_y}};
}

}  // namespace

Surroundings InfraredAdaptor::Update(const InfraredRanges& ranges, const Pose2& pose) {
  Surroundings surroundings;
  const bool says_all = !std::isnan(ranges.front) && !std::isnan(ranges.left) && !std::isnan(ranges.right);
  if (!(ranges.range_maximum > 0.0) || !says_all) return surroundings;
  surroundings.is_measured = true;
  surroundings.sensor_range = static_cast<float>(ranges.range_maximum);
  surroundings.safe_distance = static_cast<float>(configuration_.safe_distance);

  const auto cone = [&](double bearing, double range) {
    const bool has_echo = range <= ranges.range_maximum;
    return Cone{bearing, std::min(ranges.field_of_view / 2, kWidest),
                has_echo ? std::max(range, LocalMap::kLeastDistance) : ranges.range_maximum, has_echo};
  };
  const std::array cones = {cone(0.0, ranges.front), cone(kPi / 2, ranges.left),
                            cone(-kPi / 2, ranges.right)};
  surroundings.is_vague = true;
  map_.SetPose(pose);
  for (const Cone& each : cones) Carve(each, pose);
  for (const Cone& each : cones) {
    if (each.has_echo) MarkArc(each, pose);
  }
  map_.AddBoundariesTo(surroundings);
  return surroundings;
}

void InfraredAdaptor::Carve(const Cone& cone, const Pose2& pose) {
  const double free = cone.echo - configuration_.refutation_margin;
  const BodyFrame frame({pose.x, pose.y, pose.heading + cone.bearing});
  const double widening = std::tan(cone.half_width);
  const auto is_inside = [&](Point2 point) {
    const Point2 local = frame.ToBody(point);
    return local.x > 0.0 && Dot(local, local) < free * free &&
           std::abs(local.y) < widening * local.x;
  };
  map_.ForgetBoundaries(is_inside);

  const auto [low, high] =
      BoxRound(Position(pose), pose.heading + cone.bearing, cone.half_width, free);
  map_.MarkFree(low, high, is_inside);
}

void InfraredAdaptor::MarkArc(const Cone& cone, const Pose2& pose) {
  const double length = 2 * cone.half_width * cone.echo;
  if (length > configuration_.certain_arc && IsExplained(cone, pose)) return;
  // All of the arc known to be free contradicts the echo: the newer reading is right.
  if (!MarkArcPoints(cone, pose, false)) MarkArcPoints(cone, pose, true);
}

bool InfraredAdaptor::IsExplained(const Cone& cone, const Pose2& pose) const {
  bool is_explained = false;
  const BodyFrame frame({pose.x, pose.y, pose.heading + cone.bearing});
  const double widening = std::tan(cone.half_width);
  map_.ForEachBoundary([&](Point2 point) {
    const Point2 local = frame.ToBody(point);
    is_explained =
        is_explained || (local.x > 0.0 && std::abs(local.y) < widening * local.x &&
                         std::abs(Norm(local) - cone.echo) < configuration_.refutation_margin);
  });
  return is_explained;
}

bool InfraredAdaptor::MarkArcPoints(const Cone& cone, const Pose2& pose, bool even_where_free) {
  const double width = 2 * cone.half_width;
  const int steps =
      std::max(1, static_cast<int>(std::ceil(width * cone.echo / configuration_.arc_step)));
  bool has_marked = false;
  for (int step = 0; step <= steps; ++step) {
    const double bearing = cone.bearing - cone.half_width + width * step / steps;
    const Point2 point = ToWorld(pose, cone.echo * UnitVector(bearing));
    if (!even_where_free && map_.IsFree(point)) continue;
    map_.MarkBoundary(point);
    has_marked = true;
  }
  return has_marked;
}

}  // namespace runnel

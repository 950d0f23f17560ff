#include "modules/adaptors/algorithm/adaptors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace runnel {

namespace {

constexpr double kUnseenMargin = LocalMap::kCellSize;  // m, beside the body: cells are looked at, not points
constexpr double kUnseenReach = 0.30;                  // m ahead; from what it drives at it stops within less
constexpr double kWidest = DegreesToRadians(89.0);     // of half a cone

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

// How far off the boundary is that a ray met; nothing: it met none. What is too near to measure (-infinity, as
// REP 117 has it, or less than the scan can tell) is as near as it can tell.
std::optional<double> MetAt(const RangeScan& scan, float range) {
  if (std::isnan(range) || range > scan.range_maximum) return {};
  return std::max({double{range}, scan.range_minimum, LocalMap::kLeastDistance});
}

// A gap in what the rays say (NaN) hides what stands there: at 0.35 m 6 cm of it, if the gap is as wide as this. A
// little more than 10 degrees, as steps are rounded.
constexpr double kWidestGap = DegreesToRadians(10.01);

bool SaysEnough(const RangeScan& scan) {
  const std::size_t rays = scan.ranges.size();
  const double step = std::abs(scan.angle_step);
  // What nobody has filled in says nothing of where the rays went, nor of how far they could see.
  if (!(step > 0.0) || !std::isfinite(step + scan.start_angle + scan.range_minimum) || !(scan.range_maximum > 0.0))
    return false;
  // Of a whole turn the last ray lies beside the first one, and a gap may reach over both.
  const bool is_whole_turn = (static_cast<double>(rays) + 0.5) * step >= 2 * kPi;
  std::size_t silent = 0, in_a_row = 0, most_in_a_row = 0;
  for (std::size_t i = 0; i < (is_whole_turn ? 2 * rays : rays); ++i) {
    const bool is_silent = std::isnan(scan.ranges[i % rays]);
    if (is_silent && i < rays) ++silent;
    in_a_row = is_silent ? in_a_row + 1 : 0;
    most_in_a_row = std::max(most_in_a_row, in_a_row);
  }
  return 2 * silent < rays && static_cast<double>(most_in_a_row) * step <= kWidestGap;
}

}  // namespace

Surroundings BumperAdaptor::Update(const Contact& contact, const Pose2& pose) {
  Surroundings surroundings;
  surroundings.is_measured = true;
  surroundings.safe_distance = static_cast<float>(configuration_.safe_distance);
  map_.SetPose(pose);
  const double inside = configuration_.body_radius - configuration_.body_margin;
  map_.ForgetBoundaries([&](Point2 point) { return Distance(Position(pose), point) < inside; });
  // A switch that stays pressed after a touch goes on telling the old bearing, which is none any
  // more once the body has turned.
  if (contact.is_touching && contact != last_) {
    const Point2 local = configuration_.body_radius * UnitVector(contact.bearing);
    map_.MarkBoundary(ToWorld(pose, local));
  }
  last_ = contact;
  map_.AddBoundariesTo(surroundings);
  return surroundings;
}

Surroundings InfraredAdaptor::Update(const InfraredRanges& ranges, const Pose2& pose) {
  Surroundings surroundings;
  const bool says_all = !std::isnan(ranges.front) && !std::isnan(ranges.left) && !std::isnan(ranges.right);
  if (!(ranges.range_maximum > 0.0) || !(ranges.field_of_view > 0.0) || !says_all) return surroundings;
  surroundings.is_measured = true;
  surroundings.sensor_range = static_cast<float>(ranges.range_maximum);
  surroundings.safe_distance = static_cast<float>(configuration_.safe_distance);

  const auto cone = [&](double bearing, double range) {
    const bool has_echo = range <= ranges.range_maximum;
    return Cone{bearing, std::min(ranges.field_of_view / 2, kWidest),
                has_echo ? std::max(range, LocalMap::kLeastDistance) : ranges.range_maximum, has_echo};
  };
  const std::array cones = {cone(0.0, ranges.front), cone(kPi / 2, ranges.left), cone(-kPi / 2, ranges.right)};
  surroundings.is_vague = true;
  map_.SetPose(pose);
  const Point2 corner{configuration_.body_radius, configuration_.body_radius};
  map_.MarkFree(Position(pose) - corner, Position(pose) + corner,
                [&](Point2 point) { return Distance(Position(pose), point) < configuration_.body_radius; });
  for (const Cone& each : cones) Carve(each, pose);
  for (const Cone& each : cones) {
    if (each.has_echo) MarkArc(each, pose);
  }
  map_.AddBoundariesTo(surroundings);
  AddUnseen(pose, surroundings);
  return surroundings;
}

void InfraredAdaptor::AddUnseen(const Pose2& pose, Surroundings& surroundings) const {
  const BodyFrame frame(pose);
  const double radius = configuration_.body_radius + kUnseenMargin;
  const double step = LocalMap::kCellSize;
  double least = kUnseenReach;
  for (double y = -radius; y < radius + step / 2; y += step) {
    const double round = std::sqrt(std::max(0.0, radius * radius - y * y));
    // Where the body stands, nothing else is.
    for (double x = round; x - round < least; x += step) {
      if (!map_.IsUnseen(frame.ToWorld({x, y}))) continue;
      least = x - round;
      surroundings.unseen_after = static_cast<std::uint16_t>(least / Surroundings::kContourUnit);
      surroundings.unseen_sector = static_cast<std::uint8_t>(SectorOf(std::atan2(y, x)));
    }
  }
}

void InfraredAdaptor::Carve(const Cone& cone, const Pose2& pose) {
  const double free = cone.echo - configuration_.refutation_margin;
  const BodyFrame frame({pose.x, pose.y, pose.heading + cone.bearing});
  const double widening = std::tan(cone.half_width);
  const auto is_inside = [&](Point2 point) {
    const Point2 local = frame.ToBody(point);
    return local.x > 0.0 && Dot(local, local) < free * free && std::abs(local.y) < widening * local.x;
  };
  map_.ForgetBoundaries(is_inside);

  const auto [low, high] = BoxRound(Position(pose), pose.heading + cone.bearing, cone.half_width, free);
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
    is_explained = is_explained || (local.x > 0.0 && std::abs(local.y) < widening * local.x &&
                                    std::abs(Norm(local) - cone.echo) < configuration_.refutation_margin);
  });
  return is_explained;
}

bool InfraredAdaptor::MarkArcPoints(const Cone& cone, const Pose2& pose, bool even_where_free) {
  const double width = 2 * cone.half_width;
  const int steps = std::max(1, static_cast<int>(std::ceil(width * cone.echo / configuration_.arc_step)));
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

Surroundings LaserAdaptor::Update(const RangeScan& scan, const Pose2& pose) {
  Surroundings surroundings;
  if (!SaysEnough(scan)) return surroundings;
  surroundings.is_measured = true;
  surroundings.sensor_range = static_cast<float>(scan.range_maximum);
  surroundings.safe_distance = static_cast<float>(configuration_.safe_distance);

  map_.SetPose(pose);
  ForgetWhatTheScanRefutes(scan);
  const BodyFrame frame(pose);
  // Turned from ray to ray, as a sine for each would take longer than all the rest.
  const Point2 step = UnitVector(scan.angle_step);
  Point2 direction = UnitVector(scan.start_angle);
  double bearing = scan.start_angle;
  for (const float range : scan.ranges) {
    if (const auto distance = MetAt(scan, range)) {
      AddBoundaryPoint(surroundings, {*distance, bearing});
      map_.MarkBoundary(frame.ToWorld(*distance * direction));
    }
    bearing += scan.angle_step;
    direction = Turned(direction, step);
  }
  map_.AddBoundariesTo(surroundings);
  return surroundings;
}

void LaserAdaptor::ForgetWhatTheScanRefutes(const RangeScan& scan) {
  if (!(scan.angle_step > 0.0)) return;
  map_.ForgetSeenBoundaries([&](const BoundaryPoint& point) {
    const double looked_through = point.distance + configuration_.refutation_margin;
    if (looked_through > scan.range_maximum) return false;
    const double turned = point.bearing - scan.start_angle;
    const double ray = (turned < 0.0 ? turned + 2 * kPi : turned) / scan.angle_step;
    if (ray < 0.0 || ray > static_cast<double>(scan.ranges.size() - 1)) return false;
    // Both neighbours must agree: the edge of an obstacle lies between a ray that meets it and one
    // that does not.
    return scan.ranges[static_cast<std::size_t>(std::floor(ray))] > looked_through &&
           scan.ranges[static_cast<std::size_t>(std::ceil(ray))] > looked_through;
  });
}

}  // namespace runnel

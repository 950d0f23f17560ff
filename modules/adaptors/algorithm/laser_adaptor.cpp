#include "modules/adaptors/algorithm/laser_adaptor.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace runnel {

namespace {

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

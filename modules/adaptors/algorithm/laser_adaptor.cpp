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

// Where half of the rays say nothing (NaN), a wall may be.
bool SaysEnough(const RangeScan& scan) {
  const auto silent = std::ranges::count_if(scan.ranges, [](float range) { return std::isnan(range); });
  return 2 * static_cast<std::size_t>(silent) < scan.ranges.size();
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

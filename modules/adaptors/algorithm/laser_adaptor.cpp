#include "modules/adaptors/algorithm/laser_adaptor.h"

#include <cmath>

namespace runnel {

namespace {

bool MetSomething(const RangeScan& scan, float range) {
  return std::isfinite(range) && range >= 0.0F && range <= scan.range_maximum;
}

}  // namespace

Surroundings LaserAdaptor::Update(const RangeScan& scan, const Pose2& pose) {
  Surroundings surroundings;
  if (scan.ranges.empty()) return surroundings;
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
    if (MetSomething(scan, range)) {
      AddBoundaryPoint(surroundings, {range, bearing});
      map_.MarkBoundary(frame.ToWorld(double{range} * direction));
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

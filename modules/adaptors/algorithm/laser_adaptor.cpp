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

  map_.SetCentre(Position(pose));
  ForgetWhatTheScanRefutes(scan, pose);
  double bearing = scan.start_angle;
  for (const float range : scan.ranges) {
    if (MetSomething(scan, range)) {
      AddBoundaryPoint(surroundings, {range, bearing});
      map_.MarkBoundary(ToWorld(pose, double{range} * UnitVector(bearing)));
    }
    bearing += scan.angle_step;
  }
  map_.AddBoundariesTo(surroundings, pose);
  return surroundings;
}

void LaserAdaptor::ForgetWhatTheScanRefutes(const RangeScan& scan, const Pose2& pose) {
  if (!(scan.angle_step > 0.0)) return;
  const BodyFrame frame(pose);
  map_.ForgetBoundaries([&](Point2 point) {
    const Point2 local = frame.ToBody(point);
    const double turned = Direction(local) - scan.start_angle;
    const double ray = (turned < 0.0 ? turned + 2 * kPi : turned) / scan.angle_step;
    if (ray < 0.0 || ray > static_cast<double>(scan.ranges.size() - 1)) return false;
    const double looked_through = Norm(local) + configuration_.refutation_margin;
    if (looked_through > scan.range_maximum) return false;
    // Both neighbours must agree: the edge of an obstacle lies between a ray that meets it and one
    // that does not.
    return scan.ranges[static_cast<std::size_t>(std::floor(ray))] > looked_through &&
           scan.ranges[static_cast<std::size_t>(std::ceil(ray))] > looked_through;
  });
}

}  // namespace runnel

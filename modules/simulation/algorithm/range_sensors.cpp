#include "modules/simulation/algorithm/range_sensors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace runnel {

LaserScanner::LaserScanner(const LaserScannerOptions& options) : options_(options), noise_(options.seed) {
  options_.rays = std::max<std::size_t>(options_.rays, 2);
  const double step = options_.field_of_view / static_cast<double>(options_.rays - 1);
  for (std::size_t ray = 0; ray < options_.rays; ++ray) {
    directions_.push_back(UnitVector(-options_.field_of_view / 2 + static_cast<double>(ray) * step));
  }
}

void LaserScanner::Scan(const RayCaster& rays, const Pose2& pose, RangeScan& scan) {
  scan.start_angle = -options_.field_of_view / 2;
  scan.angle_step = options_.field_of_view / static_cast<double>(options_.rays - 1);
  scan.range_minimum = options_.range_minimum;
  scan.range_maximum = options_.range_maximum;
  scan.ranges.resize(options_.rays);
  rays.CastFan(Position(pose), UnitVector(pose.heading), directions_, options_.range_maximum, scan.ranges);
  const auto low = static_cast<float>(options_.range_minimum);
  const auto high = static_cast<float>(options_.range_maximum);
  for (float& range : scan.ranges) {
    if (!std::isfinite(range)) continue;
    range += static_cast<float>(noise_(options_.standard_deviation));
    range = std::clamp(range, low, high);
  }
}

InfraredSensor::InfraredSensor(const InfraredSensorOptions& options) : options_(options), noise_(options.seed) {
  options_.rays_per_cone = std::max<std::size_t>(options_.rays_per_cone, 2);
}

InfraredRanges InfraredSensor::Measure(const RayCaster& rays, const Pose2& pose) {
  InfraredRanges ranges;
  ranges.range_maximum = options_.range_maximum;
  ranges.field_of_view = options_.field_of_view;
  ranges.front = MeasureCone(rays, Position(pose), pose.heading);
  ranges.left = MeasureCone(rays, Position(pose), pose.heading + kPi / 2);
  ranges.right = MeasureCone(rays, Position(pose), pose.heading - kPi / 2);
  return ranges;
}

double InfraredSensor::MeasureCone(const RayCaster& rays, Point2 origin, double direction) {
  double least = std::numeric_limits<double>::infinity();
  const double step = options_.field_of_view / static_cast<double>(options_.rays_per_cone - 1);
  for (std::size_t i = 0; i < options_.rays_per_cone; ++i) {
    const double ray = direction - options_.field_of_view / 2 + static_cast<double>(i) * step;
    least = std::min(least, rays.Cast(origin, ray, options_.range_maximum));
  }
  if (!std::isfinite(least)) return least;
  return std::clamp(least + noise_(options_.standard_deviation), 0.0, options_.range_maximum);
}

}  // namespace runnel

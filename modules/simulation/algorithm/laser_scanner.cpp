#include "modules/simulation/algorithm/laser_scanner.h"

#include <algorithm>
#include <cmath>

namespace runnel {

LaserScanner::LaserScanner(const LaserScannerOptions& options)
    : options_(options), noise_(options.seed) {
  options_.rays = std::max<std::size_t>(options_.rays, 2);
  const double step = options_.field_of_view / static_cast<double>(options_.rays - 1);
  for (std::size_t ray = 0; ray < options_.rays; ++ray) {
    directions_.push_back(
        UnitVector(-options_.field_of_view / 2 + static_cast<double>(ray) * step));
  }
}

void LaserScanner::Scan(const RayCaster& rays, const Pose2& pose, RangeScan& scan) {
  scan.start_angle = -options_.field_of_view / 2;
  scan.angle_step = options_.field_of_view / static_cast<double>(options_.rays - 1);
  scan.range_minimum = options_.range_minimum;
  scan.range_maximum = options_.range_maximum;
  scan.ranges.resize(options_.rays);
  rays.CastFan(Position(pose), UnitVector(pose.heading), directions_, options_.range_maximum,
               scan.ranges);
  const auto low = static_cast<float>(options_.range_minimum);
  const auto high = static_cast<float>(options_.range_maximum);
  for (float& range : scan.ranges) {
    if (!std::isfinite(range)) continue;
    range += static_cast<float>(noise_(options_.standard_deviation));
    range = std::clamp(range, low, high);
  }
}

}  // namespace runnel

#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "modules/simulation/algorithm/random.h"
#include "modules/simulation/algorithm/ray_caster.h"
#include "modules/types/algorithm/angle.h"
#include "modules/types/algorithm/measurements.h"
#include "modules/types/algorithm/pose.h"

namespace runnel {

struct InfraredSensorOptions {
  double field_of_view = DegreesToRadians(26.0);  ///< rad, the whole angle of each cone
  double range_maximum = 2.0;                     ///< m
  std::size_t rays_per_cone = 27;                 ///< at least 2: how finely a cone is looked through
  double standard_deviation = 0.0;                ///< m, of the noise on every distance
  std::uint64_t seed = 1;                         ///< of the noise
};

/// Three infrared rangers at the robot's centre, looking ahead, to the left and to the right, each
/// giving the least distance in its cone. What is thinner than the gap between two of the cone's
/// rays can be missed.
///
/// Threads: not thread-safe. Allocation: none.
class InfraredSensor {
 public:
  explicit InfraredSensor(const InfraredSensorOptions& options = {}) : options_(options), noise_(options.seed) {
    options_.rays_per_cone = std::max<std::size_t>(options_.rays_per_cone, 2);
  }

  InfraredRanges Measure(const RayCaster& rays, const Pose2& pose) {
    InfraredRanges ranges;
    ranges.range_maximum = options_.range_maximum;
    ranges.field_of_view = options_.field_of_view;
    ranges.front = MeasureCone(rays, Position(pose), pose.heading);
    ranges.left = MeasureCone(rays, Position(pose), pose.heading + kPi / 2);
    ranges.right = MeasureCone(rays, Position(pose), pose.heading - kPi / 2);
    return ranges;
  }

 private:
  double MeasureCone(const RayCaster& rays, Point2 origin, double direction) {
    double least = std::numeric_limits<double>::infinity();
    const double step = options_.field_of_view / static_cast<double>(options_.rays_per_cone - 1);
    for (std::size_t i = 0; i < options_.rays_per_cone; ++i) {
      const double ray = direction - options_.field_of_view / 2 + static_cast<double>(i) * step;
      least = std::min(least, rays.Cast(origin, ray, options_.range_maximum));
    }
    if (!std::isfinite(least)) return least;
    return std::clamp(least + noise_(options_.standard_deviation), 0.0, options_.range_maximum);
  }

  InfraredSensorOptions options_;
  GaussianNoise noise_;
};

struct LaserScannerOptions {
  std::size_t rays = 181;           ///< at least 2; the first and the last are at the edges of the field
  double field_of_view = kPi;       ///< rad, half of it on either side of straight ahead
  double range_minimum = 0.02;      ///< m
  double range_maximum = 4.0;       ///< m
  double standard_deviation = 0.0;  ///< m, of the noise on every distance
  std::uint64_t seed = 1;           ///< of the noise
};

/// A planar range finder at the robot's centre, looking ahead: one ray after the other from right
/// to left, all at one moment. Noise never makes a distance less than the minimum or more than the
/// maximum, nor an echo out of none.
///
/// Threads: not thread-safe. Allocation: none once the scan has the right size.
class LaserScanner {
 public:
  explicit LaserScanner(const LaserScannerOptions& options = {}) : options_(options), noise_(options.seed) {
    options_.rays = std::max<std::size_t>(options_.rays, 2);
    const double step = options_.field_of_view / static_cast<double>(options_.rays - 1);
    for (std::size_t ray = 0; ray < options_.rays; ++ray) {
      directions_.push_back(UnitVector(-options_.field_of_view / 2 + static_cast<double>(ray) * step));
    }
  }

  /// Overwrites all of `scan`.
  void Scan(const RayCaster& rays, const Pose2& pose, RangeScan& scan) {
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

 private:
  LaserScannerOptions options_;
  GaussianNoise noise_;
  std::vector<Point2> directions_;  // of the rays, in the body's frame
};

}  // namespace runnel

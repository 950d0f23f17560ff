#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "modules/simulation/algorithm/random.h"
#include "modules/simulation/algorithm/ray_caster.h"
#include "modules/types/algorithm/angle.h"
#include "modules/types/algorithm/infrared_ranges.h"
#include "modules/types/algorithm/pose.h"
#include "modules/types/algorithm/range_scan.h"

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
  explicit InfraredSensor(const InfraredSensorOptions& options = {});

  InfraredRanges Measure(const RayCaster& rays, const Pose2& pose);

 private:
  double MeasureCone(const RayCaster& rays, Point2 origin, double direction);

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
  explicit LaserScanner(const LaserScannerOptions& options = {});

  /// Overwrites all of `scan`.
  void Scan(const RayCaster& rays, const Pose2& pose, RangeScan& scan);

 private:
  LaserScannerOptions options_;
  GaussianNoise noise_;
  std::vector<Point2> directions_;  // of the rays, in the body's frame
};

}  // namespace runnel

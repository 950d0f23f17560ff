#pragma once

#include <cstddef>
#include <cstdint>

#include "modules/simulation/algorithm/noise.h"
#include "modules/simulation/algorithm/ray_caster.h"
#include "modules/types/algorithm/angle.h"
#include "modules/types/algorithm/infrared_ranges.h"
#include "modules/types/algorithm/pose.h"

namespace runnel {

struct InfraredSensorOptions {
  double field_of_view = DegreesToRadians(26.0);  ///< rad, the whole angle of each cone
  double range_maximum = 2.0;                     ///< m
  std::size_t rays_per_cone = 27;   ///< at least 2: how finely a cone is looked through
  double standard_deviation = 0.0;  ///< m, of the noise on every distance
  std::uint64_t seed = 1;           ///< of the noise
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

}  // namespace runnel

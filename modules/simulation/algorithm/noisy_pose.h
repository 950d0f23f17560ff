#pragma once

#include <cstdint>

#include "modules/simulation/algorithm/noise.h"
#include "modules/types/algorithm/pose.h"

namespace runnel {

struct NoisyPoseOptions {
  double position_deviation = 0.0;  ///< m, standard deviation of x and of y
  double heading_deviation = 0.0;   ///< rad, standard deviation
  std::uint64_t seed = 1;
};

/// What a localisation that does not drift would say: the true pose with independent noise at
/// every measurement. Without deviations it is the true pose to the bit.
///
/// Threads: not thread-safe. Allocation: none.
class NoisyPose {
 public:
  explicit NoisyPose(const NoisyPoseOptions& options = {});

  Pose2 Measure(const Pose2& pose);

 private:
  NoisyPoseOptions options_;
  GaussianNoise noise_;
};

}  // namespace runnel

#include "modules/simulation/algorithm/noisy_pose.h"

#include "modules/types/algorithm/angle.h"

namespace runnel {

NoisyPose::NoisyPose(const NoisyPoseOptions& options) : options_(options), noise_(options.seed) {}

Pose2 NoisyPose::Measure(const Pose2& pose) {
  Pose2 measured = pose;
  measured.x += noise_(options_.position_deviation);
  measured.y += noise_(options_.position_deviation);
  const double turned = noise_(options_.heading_deviation);
  if (turned != 0.0) measured.heading = WrapAngle(measured.heading + turned);
  return measured;
}

}  // namespace runnel

#pragma once

#include <cstdint>

#include "modules/simulation/algorithm/ray_caster.h"
#include "modules/simulation/algorithm/world.h"
#include "modules/types/algorithm/angle.h"
#include "modules/types/algorithm/measurements.h"
#include "modules/types/algorithm/pose.h"

namespace runnel {

struct CameraOptions {
  std::uint32_t width = 160;                        ///< pixels, at least 1
  std::uint32_t height = 120;                       ///< pixels, at least 1
  double field_of_view = kPi / 2;                   ///< rad, across, below pi
  double range = 30.0;                              ///< m; what is further away is lost in the sky
  double eye_height = 0.25;                         ///< m, above the ground
  double obstacle_height = kDefaultObstacleHeight;  ///< m; all are drawn as high as this
};

/// What a camera at `pose`, looking level and ahead, sees of a world of upright surfaces: "rgb8", nearer is darker
/// against a light sky, with a chequered ground of 1 m squares. Overwrites all of `image`.
///
/// Allocation: none once the image has its size.
void TakePicture(const RayCaster& rays, const Pose2& pose, const CameraOptions& options, Image& image);

}  // namespace runnel

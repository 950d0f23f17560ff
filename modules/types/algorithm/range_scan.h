#pragma once

#include <vector>

namespace runnel {

/// What a planar range finder saw at one moment, in the body's frame (x ahead, y left): ray i has
/// the bearing start_angle + i * angle_step (rad, counter-clockwise) and starts at the body's
/// centre.
struct RangeScan {
  double start_angle = 0.0;    ///< rad
  double angle_step = 0.0;     ///< rad
  double range_minimum = 0.0;  ///< m; what is nearer reads range_minimum
  double range_maximum = 0.0;  ///< m
  std::vector<float> ranges;  ///< m; +infinity where nothing is within range_maximum, -infinity: too near, NaN: unknown

  friend bool operator==(const RangeScan&, const RangeScan&) = default;
};

}  // namespace runnel

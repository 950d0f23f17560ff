#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/shared_vector.h"

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

/// What three infrared rangers saw at one moment: each the least distance (m, from the body's
/// centre) to anything within its cone, +infinity if nothing is within range_maximum. The cones
/// point ahead, to the left and to the right of the body; where in a cone the echo came from, such
/// a sensor cannot tell.
struct InfraredRanges {
  double front = 0.0;
  double left = 0.0;
  double right = 0.0;
  double range_maximum = 0.0;  ///< m
  double field_of_view = 0.0;  ///< rad, the whole angle of each cone

  friend constexpr bool operator==(const InfraredRanges&, const InfraredRanges&) = default;
};

/// What a bumper all round the body says.
struct Contact {
  bool is_touching = false;
  double bearing = 0.0;  ///< rad, of the point touched, in the body's frame; 0 while not touching

  friend constexpr bool operator==(const Contact&, const Contact&) = default;
};

/// A picture, row by row from the top, pixels from the left.
struct Image {
  std::uint32_t width = 0;          ///< pixels
  std::uint32_t height = 0;         ///< pixels
  std::string encoding;             ///< of a pixel: "rgb8", "bgr8", "rgba8", "mono8", "mono16", …
  std::uint32_t row_stride = 0;     ///< bytes from the begin of a row to that of the next
  SharedVector<std::uint8_t> data;  ///< row_stride * height bytes

  friend bool operator==(const Image&, const Image&) = default;
};

}  // namespace runnel

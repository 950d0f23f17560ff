#pragma once

namespace runnel {

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

}  // namespace runnel

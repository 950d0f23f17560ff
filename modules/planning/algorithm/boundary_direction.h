#pragma once

#include <cstdint>

namespace runnel {

/// Which way a robot turns when it meets an obstacle, and so on which hand it keeps the boundary
/// while it follows it: after turning left the boundary is on the right.
enum class BoundaryDirection : std::uint8_t { kLeft, kRight };

[[nodiscard]] constexpr BoundaryDirection Opposite(BoundaryDirection direction) {
  return direction == BoundaryDirection::kLeft ? BoundaryDirection::kRight
                                               : BoundaryDirection::kLeft;
}
/// +1 if the robot turned left, -1 if it turned right: a factor that mirrors bearings so that the
/// boundary is always on the right.
[[nodiscard]] constexpr double MirrorSign(BoundaryDirection direction) {
  return direction == BoundaryDirection::kLeft ? 1.0 : -1.0;
}

}  // namespace runnel

#pragma once

#include <cmath>

namespace runnel {

/// How fast the two wheels of a differential drive turn, in rad/s, positive ahead.
struct WheelSpeeds {
  double left = 0.0;
  double right = 0.0;

  friend constexpr bool operator==(const WheelSpeeds&, const WheelSpeeds&) = default;
};
[[nodiscard]] inline bool IsFinite(const WheelSpeeds& speeds) {
  return std::isfinite(speeds.left) && std::isfinite(speeds.right);
}

}  // namespace runnel

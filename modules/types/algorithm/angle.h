#pragma once

#include <cmath>
#include <numbers>

namespace runnel {

inline constexpr double kPi = std::numbers::pi;

/// The same direction within (-pi, pi] rad. Precondition: finite.
[[nodiscard]] inline double WrapAngle(double angle) {
  if (angle > -kPi && angle <= kPi) return angle;  // most are, and a division takes long
  const double wrapped = std::remainder(angle, 2 * kPi);
  return wrapped <= -kPi ? kPi : wrapped;
}

[[nodiscard]] constexpr double DegreesToRadians(double degrees) { return degrees * kPi / 180.0; }

}  // namespace runnel

#pragma once

namespace runnel {

/// 0 within `width` of 0, and what is beyond that outside, so that there is no jump at the edge.
[[nodiscard]] constexpr double DeadBand(double value, double width) noexcept {
  if (value > width) return value - width;
  if (value < -width) return value + width;
  return value == value ? 0 : value;  // what is no number stays so
}

}  // namespace runnel

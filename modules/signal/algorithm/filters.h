#pragma once

#include <algorithm>
#include <cmath>

namespace runnel {

/// 0 within `width` of 0, and what is beyond that outside, so that there is no jump at the edge.
[[nodiscard]] constexpr double DeadBand(double value, double width) noexcept {
  if (value > width) return value - width;
  if (value < -width) return value + width;
  return value == value ? 0 : value;  // what is no number stays so
}

/// A low pass of first order, exact for steps of any length: after one time constant of a constant input 63 % of the
/// way are done. Begins at the first value.
class LowPass {
 public:
  /// `seconds` have passed since the last call. A time constant that is not positive lets everything pass.
  double Next(double value, double seconds, double time_constant) noexcept {
    if (!std::isfinite(value)) return value;  // is passed on, and does not stay
    const bool passes = !has_begun_ || !(time_constant > 0);
    value_ = passes ? value : value_ + (value - value_) * -std::expm1(-seconds / time_constant);
    has_begun_ = true;
    return value_;
  }
  /// As if it had put out `value` last.
  void Begin(double value) noexcept {
    value_ = value;
    has_begun_ = true;
  }
  [[nodiscard]] bool has_begun() const noexcept { return has_begun_; }

 private:
  double value_ = 0;
  bool has_begun_ = false;
};

/// Follows a value no faster than allowed. Begins at the first value.
class RateLimiter {
 public:
  /// `seconds` have passed since the last call. `rise` and `fall`: per second, neither negative.
  double Next(double value, double seconds, double rise, double fall) noexcept {
    if (!std::isfinite(value)) return value;  // is passed on, and does not stay
    value_ =
        has_begun_ ? std::clamp(value, value_ - fall * seconds, value_ + rise * seconds) : value;
    has_begun_ = true;
    return value_;
  }
  /// As if it had put out `value` last.
  void Begin(double value) noexcept {
    value_ = value;
    has_begun_ = true;
  }
  [[nodiscard]] bool has_begun() const noexcept { return has_begun_; }

 private:
  double value_ = 0;
  bool has_begun_ = false;
};

}  // namespace runnel

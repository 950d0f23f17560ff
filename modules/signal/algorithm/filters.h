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

/// What a filter has put out last, from which it goes on. It begins at the first value.
class FilterState {
 public:
  /// As if it had put out `value` last; returns that.
  double Begin(double value) noexcept {
    has_begun_ = true;
    return value_ = value;
  }
  [[nodiscard]] bool has_begun() const noexcept { return has_begun_; }

 protected:
  double value_ = 0;

 private:
  bool has_begun_ = false;
};

/// A low pass of first order, exact for steps of any length: after one time constant of a constant input 63 % of the
/// way are done.
class LowPass : public FilterState {
 public:
  /// `seconds` have passed since the last call. A time constant that is not positive lets everything pass.
  double Next(double value, double seconds, double time_constant) noexcept {
    if (!std::isfinite(value)) return value;  // is passed on, and does not stay
    const bool passes = !has_begun() || !(time_constant > 0);
    return Begin(passes ? value : value_ + (value - value_) * -std::expm1(-seconds / time_constant));
  }
};

/// Follows a value no faster than allowed.
class RateLimiter : public FilterState {
 public:
  /// `seconds` have passed since the last call. `rise` and `fall`: per second, neither negative.
  double Next(double value, double seconds, double rise, double fall) noexcept {
    if (!std::isfinite(value)) return value;  // is passed on, and does not stay
    return Begin(has_begun() ? std::clamp(value, value_ - fall * seconds, value_ + rise * seconds) : value);
  }
};

}  // namespace runnel

#pragma once

#include <algorithm>

namespace runnel {

/// Follows a value no faster than allowed. Begins at the first value.
class RateLimiter {
 public:
  /// `seconds` have passed since the last call. `rise` and `fall`: per second, neither negative.
  double Next(double value, double seconds, double rise, double fall) noexcept {
    value_ =
        has_begun_ ? std::clamp(value, value_ - fall * seconds, value_ + rise * seconds) : value;
    has_begun_ = true;
    return value_;
  }

 private:
  double value_ = 0;
  bool has_begun_ = false;
};

}  // namespace runnel

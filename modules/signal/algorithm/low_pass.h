#pragma once

#include <cmath>

namespace runnel {

/// A low pass of first order, exact for steps of any length: after one time constant of a constant input 63 % of the
/// way are done. Begins at the first value.
class LowPass {
 public:
  /// `seconds` have passed since the last call. A time constant that is not positive lets everything pass.
  double Next(double value, double seconds, double time_constant) noexcept {
    const bool passes = !has_begun_ || !(time_constant > 0);
    value_ = passes ? value : value_ + (value - value_) * -std::expm1(-seconds / time_constant);
    has_begun_ = true;
    return value_;
  }

 private:
  double value_ = 0;
  bool has_begun_ = false;
};

}  // namespace runnel

#pragma once

#include <algorithm>

#include "modules/types/algorithm/pose.h"

namespace runnel {

struct AccelerationLimits {
  double forward = 1.0;  ///< m/s^2, > 0
  double turn = 4.0;     ///< rad/s^2, > 0
};

/// Lets a wanted motion change no faster than the body can follow. Starts at standstill.
class AccelerationLimiter {
 public:
  explicit AccelerationLimiter(const AccelerationLimits& limits = {}) : limits_(limits) {}

  /// The motion `time_step` s (>= 0) after the one before, as near to `wanted` as the limits allow.
  [[nodiscard]] Twist2 Update(const Twist2& wanted, double time_step) {
    current_.forward = Approach(current_.forward, wanted.forward, limits_.forward * time_step);
    current_.turn = Approach(current_.turn, wanted.turn, limits_.turn * time_step);
    return current_;
  }
  /// Goes on from this motion, for example from standstill after an emergency stop.
  void Reset(const Twist2& current = {}) { current_ = current; }

 private:
  static double Approach(double value, double wanted, double step) {
    return value + std::clamp(wanted - value, -step, step);
  }

  AccelerationLimits limits_;
  Twist2 current_;
};

}  // namespace runnel

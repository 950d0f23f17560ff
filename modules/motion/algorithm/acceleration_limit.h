#pragma once

#include <algorithm>

#include "modules/types/algorithm/pose.h"

namespace runnel {

/// How fast a body may change its motion.
struct AccelerationLimit {
  double forward = 1.0;  ///< m/s^2, getting faster or slower
  double turn = 6.0;     ///< rad/s^2
};

/// The motion nearest to `wanted` that can be had `time_step` s after `current`.
[[nodiscard]] inline Twist2 Approach(const AccelerationLimit& limit, const Twist2& current,
                                     const Twist2& wanted, double time_step) {
  const auto step = [time_step](double from, double to, double rate) {
    return from + std::clamp(to - from, -rate * time_step, rate * time_step);
  };
  return {step(current.forward, wanted.forward, limit.forward),
          step(current.turn, wanted.turn, limit.turn)};
}

}  // namespace runnel

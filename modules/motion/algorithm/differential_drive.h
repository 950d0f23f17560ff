#pragma once

#include <algorithm>
#include <cmath>

#include "modules/types/algorithm/pose.h"

namespace runnel {

/// The drive of a body on two wheels, left and right of its centre.
struct DifferentialDrive {
  double wheel_radius = 0.05;      ///< m
  double track = 0.25;             ///< m, from wheel to wheel
  double maximum_speed = 0.5;      ///< m/s of the body, ahead or back
  double maximum_turn_rate = 1.5;  ///< rad/s of the body, either way
};

/// `wanted` within the drive's limits, slowed down as a whole: the curve stays the same. What is no
/// finite number becomes standstill.
[[nodiscard]] inline Twist2 WithinLimits(const DifferentialDrive& drive, const Twist2& wanted) {
  if (!std::isfinite(wanted.forward) || !std::isfinite(wanted.turn)) return {};
  const double excess =
      std::max({1.0, std::abs(wanted.forward) / drive.maximum_speed, std::abs(wanted.turn) / drive.maximum_turn_rate});
  return {wanted.forward / excess, wanted.turn / excess};
}

/// How fast a body may change its motion.
struct AccelerationLimit {
  double forward = 1.0;  ///< m/s^2, getting faster or slower
  double turn = 6.0;     ///< rad/s^2
};

/// The motion nearest to `wanted` that can be had `time_step` s after `current`.
[[nodiscard]] inline Twist2 Approach(const AccelerationLimit& limit, const Twist2& current, const Twist2& wanted,
                                     double time_step) {
  const auto step = [time_step](double from, double to, double rate) {
    return from + std::clamp(to - from, -rate * time_step, rate * time_step);
  };
  return {step(current.forward, wanted.forward, limit.forward), step(current.turn, wanted.turn, limit.turn)};
}

/// How the wheels turn when the body moves by `twist`, rolling without slip.
[[nodiscard]] inline WheelSpeeds WheelSpeedsFor(const DifferentialDrive& drive, const Twist2& twist) {
  const double difference = twist.turn * drive.track / 2;
  return {(twist.forward - difference) / drive.wheel_radius, (twist.forward + difference) / drive.wheel_radius};
}

}  // namespace runnel

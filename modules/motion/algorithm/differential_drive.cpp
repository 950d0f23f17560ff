#include "modules/motion/algorithm/differential_drive.h"

#include <algorithm>
#include <cmath>

namespace runnel {

namespace {

// How often a value is as large as it may be; at least once.
double Excess(double value, double limit) { return std::max(1.0, std::abs(value) / limit); }

}  // namespace

WheelSpeeds DifferentialDrive::ToWheels(const Twist2& wanted) const {
  const WheelSpeeds wheels = Unlimited(wanted);
  const double excess = std::max({Excess(wanted.forward, configuration_.forward_limit),
                                  Excess(wanted.turn, configuration_.turn_limit),
                                  Excess(wheels.left, configuration_.wheel_limit),
                                  Excess(wheels.right, configuration_.wheel_limit)});
  return {wheels.left / excess, wheels.right / excess};
}

Twist2 DifferentialDrive::ToTwist(const WheelSpeeds& speeds) const {
  const double radius = configuration_.wheel_radius;
  return {radius * (speeds.right + speeds.left) / 2,
          radius * (speeds.right - speeds.left) / configuration_.track_width};
}

WheelSpeeds DifferentialDrive::Unlimited(const Twist2& twist) const {
  const double difference = twist.turn * configuration_.track_width / 2;
  return {(twist.forward - difference) / configuration_.wheel_radius,
          (twist.forward + difference) / configuration_.wheel_radius};
}

}  // namespace runnel

#pragma once

#include "modules/types/algorithm/pose.h"
#include "modules/types/algorithm/wheel_speeds.h"

namespace runnel {

struct DifferentialDriveConfiguration {
  double wheel_radius = 0.05;  ///< m, > 0
  double track_width = 0.25;   ///< m between the wheels' planes, > 0
  double forward_limit = 0.5;  ///< m/s
  double turn_limit = 1.5;     ///< rad/s
  double wheel_limit = 20.0;   ///< rad/s of each wheel
};

/// From a wanted motion of the body to the speeds of its two wheels. A motion beyond a limit is
/// scaled as a whole, so that the body goes the same way, only slower.
class DifferentialDrive {
 public:
  explicit DifferentialDrive(const DifferentialDriveConfiguration& configuration = {})
      : configuration_(configuration) {}

  [[nodiscard]] WheelSpeeds ToWheels(const Twist2& wanted) const;
  /// How the body moves while its wheels turn so, without slip.
  [[nodiscard]] Twist2 ToTwist(const WheelSpeeds& speeds) const;

 private:
  [[nodiscard]] WheelSpeeds Unlimited(const Twist2& twist) const;

  DifferentialDriveConfiguration configuration_;
};

}  // namespace runnel

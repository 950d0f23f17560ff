#pragma once

namespace runnel {

/// A round robot on two driven wheels, left and right of its centre, without any sideways slip.
struct RobotOptions {
  double radius = 0.15;               ///< m
  double height = 0.3;                ///< m
  double ground_clearance = 0.05;     ///< m, of the body; what is lower cannot touch it
  double mass = 10.0;                 ///< kg
  double wheel_radius = 0.05;         ///< m
  double track = 0.25;                ///< m, from wheel to wheel
  double maximum_speed = 0.5;         ///< m/s ahead or back
  double maximum_turn_rate = 1.5;     ///< rad/s either way
  double maximum_wheel_force = 10.0;  ///< N, of each wheel along the ground; bounds acceleration
  double maximum_grip = 80.0;         ///< N, of both wheels together across the rolling direction
  double wall_friction = 0.1;         ///< Coulomb's coefficient between body and obstacle
};

}  // namespace runnel

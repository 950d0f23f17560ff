#pragma once

#include <btBulletDynamicsCommon.h>

#include "modules/simulation/algorithm/robot_options.h"
#include "modules/types/algorithm/wheel_speeds.h"

namespace runnel::internal {

/// Two driven wheels as three rows of Bullet's constraint solver: the ground speed of the left
/// wheel, that of the right one, and no speed sideways.
class WheelConstraint final : public btTypedConstraint {
 public:
  /// `ground` is any fixed body: Bullet's own one is shared by all worlds of the process.
  WheelConstraint(btRigidBody& body, btRigidBody& ground, const RobotOptions& robot);

  /// Within the limits of the robot already.
  void set_target(const WheelSpeeds& speeds) { target_ = speeds; }
  /// For one step: the direction in which the wheels roll during it (rad), and its duration (s).
  void Prepare(double rolling_direction, double step);

  void getInfo1(btConstraintInfo1* info) override;
  void getInfo2(btConstraintInfo2* info) override;
  void setParam(int, btScalar, int) override {}
  btScalar getParam(int, int) const override { return 0; }

 private:
  void FillRow(btConstraintInfo2* info, int row, const btVector3& direction, double lever,
               double speed, double force) const;

  const RobotOptions robot_;
  WheelSpeeds target_;
  double rolling_direction_ = 0.0;
  double step_ = 0.0;
};

}  // namespace runnel::internal

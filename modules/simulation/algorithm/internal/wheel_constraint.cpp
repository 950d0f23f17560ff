#include "modules/simulation/algorithm/internal/wheel_constraint.h"

#include <cmath>

namespace runnel::internal {

WheelConstraint::WheelConstraint(btRigidBody& body, btRigidBody& ground, const RobotOptions& robot)
    : btTypedConstraint(D6_CONSTRAINT_TYPE, body, ground), robot_(robot) {}

void WheelConstraint::Prepare(double rolling_direction, double step) {
  rolling_direction_ = rolling_direction;
  step_ = step;
}

void WheelConstraint::getInfo1(btConstraintInfo1* info) {
  info->m_numConstraintRows = 3;
  info->nub = 0;
}

void WheelConstraint::getInfo2(btConstraintInfo2* info) {
  const double c = std::cos(rolling_direction_), s = std::sin(rolling_direction_);
  const btVector3 ahead(c, s, 0), left(-s, c, 0);
  const double arm = robot_.track / 2, radius = robot_.wheel_radius;
  FillRow(info, 0, ahead, -arm, radius * target_.left, robot_.maximum_wheel_force);
  FillRow(info, 1, ahead, arm, radius * target_.right, robot_.maximum_wheel_force);
  FillRow(info, 2, left, 0.0, 0.0, robot_.maximum_grip);
}

/// velocity * direction + turn rate * lever shall be `speed`; limits are impulses.
void WheelConstraint::FillRow(btConstraintInfo2* info, int row, const btVector3& direction,
                              double lever, double speed, double force) const {
  const int first = row * info->rowskip;
  for (int axis = 0; axis < 3; ++axis) info->m_J1linearAxis[first + axis] = direction[axis];
  info->m_J1angularAxis[first + 2] = lever;
  info->m_constraintError[first] = speed;
  info->m_lowerLimit[first] = -force * step_;
  info->m_upperLimit[first] = force * step_;
}

}  // namespace runnel::internal

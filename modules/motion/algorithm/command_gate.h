#pragma once

#include <cmath>

#include "modules/types/algorithm/contact.h"
#include "modules/types/algorithm/pose.h"

namespace runnel {

/// The last word before the wheels: passes a command on only while it is fresh and the body touches
/// nothing; standstill otherwise, also for a command that is no number.
///
/// It stands still for any contact. To back off from a wall is a decision for the layers above, and
/// one they can take only with a sensor that sees where to.
class CommandGate {
 public:
  /// Commands older than `timeout` s stop the robot.
  explicit CommandGate(double timeout = 0.3) : timeout_(timeout) {}

  /// `age`: s since the command was given. An age that is no number counts as too old.
  [[nodiscard]] Twist2 Pass(const Twist2& command, double age, const Contact& contact) const {
    const bool is_fresh = age <= timeout_;
    const bool is_number = std::isfinite(command.forward) && std::isfinite(command.turn);
    return is_fresh && is_number && !contact.is_touching ? command : Twist2{};
  }

 private:
  double timeout_;
};

}  // namespace runnel

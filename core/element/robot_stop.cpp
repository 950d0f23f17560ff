#include "core/element/robot_stop.h"

#include <utility>

#include "core/element/runtime.h"

namespace runnel {

RobotStop::RobotStop(const Runtime& runtime) : runtime_(runtime) {}

bool RobotStop::Press(std::string by) {
  if (signal_->Press([&] { Note(true, std::move(by)); })) return true;
  const std::lock_guard lock(mutex_);
  ++state_.requests;
  state_.pressed = SteadyClock().Now();
  return false;
}

bool RobotStop::Release(std::string by) {
  return signal_->Release([&] { return runtime_.clock().Now(); },
                          [&] { Note(false, std::move(by)); });
}

RobotStop::State RobotStop::state() const {
  const std::lock_guard lock(mutex_);
  State state = state_;
  state.in_force = in_force();  // it may have changed, and not be noted yet
  return state;
}

void RobotStop::Note(bool in_force, std::string by) {
  const std::lock_guard lock(mutex_);
  state_ = {in_force, std::move(by), runtime_.clock().Now(), state_.changes + 1, state_.requests + 1,
            in_force ? SteadyClock().Now() : state_.pressed};
}

}  // namespace runnel

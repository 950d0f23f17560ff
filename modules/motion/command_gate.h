#pragma once

#include <optional>

#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "modules/motion/algorithm/command_gate.h"
#include "modules/types/contact.h"
#include "modules/types/pose.h"
#include "plugins/parameters/parameter.h"

namespace runnel {

inline void Describe(TypeBuilder<GateState>& type) {
  type.Name("GateState")
      .Value("open", GateState::kOpen)
      .Value("no_command", GateState::kNoCommand)
      .Value("old_command", GateState::kOldCommand)
      .Value("contact", GateState::kContact)
      .Value("stopped", GateState::kStopped);
}

/// Stands between whoever commands and the drive: lets commands pass while they are fresh and
/// nothing is touched, and commands standstill otherwise. So a planner that was stopped by a fault
/// cannot leave the robot driving.
class CommandGate final : public Module {
 public:
  using Module::Module;

  Input<Twist2> wanted{
      this, "wanted", {.description = "what the planner commands", .required = true}};
  Input<Contact> contact{this, "contact", {.description = "what a bumper says"}};
  Output<Twist2> allowed{this, "allowed", {.description = "the same, or standstill"}};
  Output<GateState> state{this, "state", {.description = "why commands do not pass"}};

  Parameter<double> timeout{this,
                            "timeout",
                            {.default_value = 0.5,
                             .bounds = {0.01, 60.0},
                             .unit = "s",
                             .description = "older commands do not pass"}};
  Parameter<bool> stop{
      this, "stop", {.default_value = false, .description = "holds the robot whatever comes"}};

 private:
  void Update() override {
    const auto command = wanted.Read();
    const Contact touch = contact.Read().value_or(Contact{});
    std::optional<double> age;
    if (command) age = ToSeconds(now() - command.timestamp());
    const GateState verdict = CheckCommand(age, timeout.Get(), touch, stop.Get());
    allowed.Publish(verdict == GateState::kOpen ? *command : Twist2{});
    state.Publish(verdict);
  }
};

}  // namespace runnel

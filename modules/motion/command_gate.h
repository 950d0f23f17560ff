#pragma once

#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "modules/types/measurements.h"
#include "modules/types/pose.h"
#include "plugins/parameters/input_timeout.h"
#include "plugins/parameters/parameter.h"

namespace runnel {

/// Why a command does not pass: of commands in the words of InputTimeout, which the log has, too.
enum class GateState {
  kOpen,
  kNeverCame,   ///< no command
  kOld,         ///< the last command: whoever commands has fallen silent
  kContact,     ///< the body touches something
  kStopped,     ///< somebody has closed the gate, or the robot is stopped
  kNotANumber,  ///< the command
  kOldContact,  ///< the bumper has fallen silent, or has never spoken
};

inline void Describe(TypeBuilder<GateState>& type) {
  type.Name("GateState")
      .Values<GateState::kOpen, GateState::kNeverCame, GateState::kOld, GateState::kContact, GateState::kStopped,
              GateState::kNotANumber, GateState::kOldContact>();
}

/// Stands between whoever commands and the drive: lets commands pass while they are fresh and
/// nothing is touched, and commands standstill otherwise. So a planner that has failed
/// cannot leave the robot driving.
class CommandGate final : public Module {
 public:
  explicit CommandGate(const Placement& placement) : Module(placement) { KeepState(has_bumper_); }

  Input<Twist2> wanted{this, "wanted", Driving("what the planner commands")};
  /// Commands are no older for it.
  Input<Contact> contact{this, "contact", {.description = "what a bumper says", .ageing = Ageing::kSetOnce}};
  Output<Twist2> allowed{this, "allowed", {.description = "the same, or standstill"}};
  Output<GateState> state{this, "state", {.description = "why commands do not pass"}};

  InputTimeout wanted_timeout{this, wanted, {.former_name = "timeout", .log = &log()}};
  /// A bumper that is connected has to speak, and has to go on speaking, also if it is disconnected or another gate takes the
  /// place of this one. A bumper that says only what has changed needs a longer time-out.
  InputTimeout contact_timeout{this, contact, {.log = &log()}};
  Parameter<bool> stop{this, "stop", {.default_value = false, .description = "holds the robot whatever comes"}};

 private:
  // One that is disconnected before the first cycle counts, too.
  Result<void> Prepare() override {
    has_bumper_ = contact.is_bound();
    return {};
  }
  void Update() override {
    const auto command = wanted_timeout.Read(wanted, now());
    has_bumper_ = has_bumper_ || contact.is_bound();
    const auto touch = has_bumper_ ? contact_timeout.Read(contact, now()) : Lease<Contact>();
    const GateState verdict = Check(touch);
    allowed.Publish(verdict == GateState::kOpen ? *command : Twist2{});
    state.Publish(verdict);
  }
  [[nodiscard]] GateState Check(const Lease<Contact>& touch) const {
    if (stop.Get() || wanted.is_stop_in_force()) return GateState::kStopped;
    if (wanted_timeout.lack() == InputLack::kNeverCame) return GateState::kNeverCame;
    if (has_bumper_ && !touch) return GateState::kOldContact;
    if (touch && touch->is_touching) return GateState::kContact;
    if (wanted_timeout.lack() == InputLack::kNone) return GateState::kOpen;
    return wanted_timeout.lack() == InputLack::kOld ? GateState::kOld : GateState::kNotANumber;
  }

  bool has_bumper_ = false;
};

}  // namespace runnel

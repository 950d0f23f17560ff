#pragma once

#include <optional>

#include "modules/types/algorithm/contact.h"
#include "modules/types/algorithm/pose.h"

namespace runnel {

/// Why a command does not pass.
enum class GateState {
  kOpen,
  kNoCommand,   ///< none has come yet
  kOldCommand,  ///< the last one is older than the gate allows: whoever commands has fallen silent
  kContact,     ///< the body touches something
  kStopped,     ///< somebody has closed the gate
};

/// Lets motion commands pass only while they are fresh and nothing is touched. `age` is that of the
/// last command in s, nothing if none has come; `is_closed` stops all of them.
[[nodiscard]] inline GateState CheckCommand(std::optional<double> age, double oldest,
                                            const Contact& contact, bool is_closed = false) {
  if (is_closed) return GateState::kStopped;
  if (!age) return GateState::kNoCommand;
  if (contact.is_touching) return GateState::kContact;
  return *age > oldest ? GateState::kOldCommand : GateState::kOpen;
}

}  // namespace runnel

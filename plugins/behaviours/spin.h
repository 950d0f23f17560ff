#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "plugins/behaviours/promela.h"

namespace runnel {

/// A run that breaks a property: which behaviours are active in each cycle, by their places.
struct Counterexample {
  std::vector<std::vector<bool>> cycles;
  std::size_t repeats_from = 0;  ///< from here to the end over and over; cycles.size(): it ends there
};

/// What Spin found: nothing, or a run.
struct SpinVerdict {
  bool holds = false;
  Counterexample counterexample = {};
};

/// Has the model checker (`plugins/model_checker`) decide. Takes a second or more. Errors: spin, or the
/// compiler that it needs, is not here; it has not come to an end in a minute; it says something else.
[[nodiscard]] Result<SpinVerdict> CheckBySpin(const BehaviourNetwork& network, const NetworkProperty& property);

/// For people: "drive; then drive, motion; then nobody, over and over".
[[nodiscard]] std::string TellCounterexample(const BehaviourNetwork& network, const Counterexample& counterexample);

}  // namespace runnel

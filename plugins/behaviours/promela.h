#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "plugins/behaviours/network.h"

namespace runnel {

/// What a network must keep to.
struct NetworkProperty {
  enum class Kind {
    kNever,       ///< never are all of `active` active and none of `others`
    kEventually,  ///< all of `active` are active some time, each time after all of `others` were; without others: once
  };
  Kind kind = Kind::kNever;
  std::vector<std::size_t> active;
  std::vector<std::size_t> others = {};
};

/// The network in the language of Spin: in each cycle, each behaviour that may decides whether it wants to be active, in any way
/// (for kEventually: who wants to, wants until it has been, and nobody does or rests for more than three cycles), and all are
/// worked out in their order. A run
/// prints "runnel 0101…" for each cycle. `property`: nullptr for none.
[[nodiscard]] std::string PromelaText(const BehaviourNetwork& network, const NetworkProperty* property);

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

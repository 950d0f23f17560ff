#pragma once

#include "core/types/type_of.h"
#include "plugins/behaviours/algorithm/activation.h"

namespace runnel {

inline void Describe(TypeBuilder<StimulationMode>& type) {
  type.Name("StimulationMode")
      .Value("auto", StimulationMode::kAuto)
      .Value("enabled", StimulationMode::kEnabled)
      .Value("disabled", StimulationMode::kDisabled);
}

/// What viewers show of a behaviour. Copied freely.
struct BehaviourState {
  double activation = 0.0;
  double activity = 0.0;
  double target_rating = 0.0;
  StimulationMode mode = StimulationMode::kAuto;

  friend bool operator==(const BehaviourState&, const BehaviourState&) = default;
};

inline void Describe(TypeBuilder<BehaviourState>& type) {
  type.Name("BehaviourState")
      .SemanticTag("behaviour_state")
      .Field("activation", &BehaviourState::activation)
      .Field("activity", &BehaviourState::activity)
      .Field("target_rating", &BehaviourState::target_rating)
      .Field("mode", &BehaviourState::mode);
}

}  // namespace runnel

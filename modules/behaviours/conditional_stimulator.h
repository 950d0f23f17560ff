#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "core/types/builtin_types.h"
#include "modules/behaviours/algorithm/conditions.h"
#include "plugins/behaviours/behaviour.h"
#include "plugins/parameters/input_timeout.h"

namespace runnel {

inline void Describe(TypeBuilder<ConditionKind>& type) {
  type.Name("ConditionKind").Values<ConditionKind::kPermanent, ConditionKind::kOrdering, ConditionKind::kEnabling>();
}
inline void Describe(TypeBuilder<Relation>& type) {
  type.Name("Relation")
      .Values<Relation::kGreater, Relation::kAtLeast, Relation::kEqual, Relation::kAtMost, Relation::kLess,
              Relation::kNotEqual>();
}

/// Which conditions of a conditional stimulator have been met, for who takes its place: bit i for condition i.
struct MetConditions {
  std::uint32_t inputs = 0;
  std::uint32_t feedbacks = 0;
};
inline void Describe(TypeBuilder<MetConditions>& type) {
  type.Name("MetConditions").Fields<&MetConditions::inputs, &MetConditions::feedbacks>();
}

/// Stimulates others when conditions are met, in an order if they ask for one: for sequences. The ports input1 … and
/// feedback1 … take numbers, activities and target ratings; parameters of the names input1_kind, input1_relation, input1_threshold …
/// say what they are compared with, and for how long that counts (ConditionKind).
///
/// All inputs true: activity = activation, target rating 1; else both 0. When all feedbacks are true, or something comes to
/// reset, all is forgotten; so a step begins anew.
class ConditionalStimulator final : public Behaviour {
 public:
  explicit ConditionalStimulator(const Placement& placement) : Behaviour(placement) { KeepState(met_); }
  static constexpr std::uint32_t kMostConditions = 32;

  StaticParameter<std::uint32_t> inputs{
      this, "inputs", {.default_value = 1, .bounds = {0, kMostConditions}, .description = "how many conditions"}};
  StaticParameter<std::uint32_t> feedbacks{
      this,
      "feedbacks",
      {.default_value = 0, .bounds = {0, kMostConditions}, .description = "how many conditions that end it"}};
  /// Permanent conditions that something is more than nothing.
  [[nodiscard]] ActivityNeeds Needs() const override;

  Input<Signal> reset{this, "reset", {.description = "forgets what has been met", .ageing = Ageing::kSetOnce}};

 private:
  /// Conditions of one kind, with their ports and parameters.
  struct Conditions {
    std::deque<Input<double>> ports;
    std::deque<InputTimeout> timeouts;
    std::deque<Parameter<ConditionKind>> kinds;
    std::deque<Parameter<Relation>> relations;
    std::deque<Parameter<double>> thresholds;
    std::vector<ConditionState> states;
  };

  Result<void> Construct() override;
  void OnBehaviourParametersChanged() override;
  std::optional<Outcome> Behave(double activation) override;
  void Add(const std::string& name, Conditions& conditions, bool goes_round);
  static void TakeParameters(Conditions& conditions);
  [[nodiscard]] bool ReadValues(Conditions& conditions, std::uint32_t met);

  Conditions inputs_;
  Conditions feedbacks_;
  MetConditions met_;
};

}  // namespace runnel

#include "modules/behaviours/algorithm/conditions.h"

namespace runnel {

namespace {

bool HoldsNow(const ConditionState& state) {
  return Holds(state.value, state.condition.relation, state.condition.threshold);
}

// Those that enabling ones wait for.
bool AreBasicOnesTrue(std::span<ConditionState> conditions) {
  bool are_true = true;
  for (ConditionState& each : conditions) {
    switch (each.condition.kind) {
      case ConditionKind::kPermanent:
        are_true = HoldsNow(each) && are_true;
        break;
      case ConditionKind::kOrdering:
        each.is_latched = each.is_latched || HoldsNow(each);
        are_true = each.is_latched && are_true;
        break;
      case ConditionKind::kEnabling:
        break;
    }
  }
  return are_true;
}

}  // namespace

bool Holds(double value, Relation relation, double threshold) {
  switch (relation) {
    case Relation::kGreater:
      return value > threshold;
    case Relation::kAtLeast:
      return value >= threshold;
    case Relation::kEqual:
      return value == threshold;
    case Relation::kAtMost:
      return value <= threshold;
    case Relation::kLess:
      return value < threshold;
    case Relation::kNotEqual:
      return value != threshold;
  }
  return false;
}

bool AreAllTrue(std::span<ConditionState> conditions) {
  const bool are_basic_ones_true = AreBasicOnesTrue(conditions);
  bool are_true = are_basic_ones_true;
  for (ConditionState& each : conditions) {
    if (each.condition.kind != ConditionKind::kEnabling) continue;
    each.is_latched = are_basic_ones_true && (each.is_latched || HoldsNow(each));
    are_true = each.is_latched && are_true;
  }
  return are_true;
}

void Reset(std::span<ConditionState> conditions) {
  for (ConditionState& each : conditions) each.is_latched = false;
}

}  // namespace runnel

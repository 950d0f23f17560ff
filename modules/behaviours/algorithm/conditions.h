#pragma once

#include <span>

namespace runnel {

enum class Relation { kGreater, kAtLeast, kEqual, kAtMost, kLess, kNotEqual };
[[nodiscard]] bool Holds(double value, Relation relation, double threshold);

enum class ConditionKind {
  kPermanent,  ///< holds now
  kOrdering,   ///< has held since the reset
  kEnabling,   ///< has held while all permanent and ordering ones did, and these have not ceased to since
};

/// One condition of a conditional stimulator.
struct Condition {
  ConditionKind kind = ConditionKind::kPermanent;
  Relation relation = Relation::kGreater;
  double threshold = 0.5;
};

/// A condition, what is there now, and what it remembers.
struct ConditionState {
  Condition condition = {};
  double value = 0.0;
  bool is_latched = false;
};

/// One cycle: whether all are true. None: they are. Changes what they remember.
[[nodiscard]] bool AreAllTrue(std::span<ConditionState> conditions);
/// They remember nothing.
void Reset(std::span<ConditionState> conditions);

}  // namespace runnel

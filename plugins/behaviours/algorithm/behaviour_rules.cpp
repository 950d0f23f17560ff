#include "plugins/behaviours/algorithm/behaviour_rules.h"

#include <string_view>

#include <fmt/format.h>

namespace runnel {

namespace {

std::string FindWrongNumber(std::string_view name, double value) {
  if (IsMetaValue(value)) return {};
  return fmt::format("{} is {}, which is not within 0 and 1", name, value);
}

std::string FindWrongNumber(const MetaSignals& signals) {
  for (const auto& [name, value] : {std::pair<std::string_view, double>{"activation", signals.activation},
                                    {"activity", signals.activity},
                                    {"target rating", signals.target_rating}}) {
    if (auto wrong = FindWrongNumber(name, value); !wrong.empty()) return wrong;
  }
  return {};
}

std::string FindUnlimited(const BehaviourCycle& cycle) {
  const MetaSignals& now = cycle.now;
  if (now.activity > now.activation) {
    return fmt::format("its activity {} is greater than its activation {}", now.activity, now.activation);
  }
  for (std::size_t i = 0; i < cycle.derived.size(); ++i) {
    const double derived = cycle.derived[i];
    if (derived >= 0.0 && derived <= now.activity) continue;
    return fmt::format("its derived activity {} is {}, which is not within 0 and its activity {}", i + 1, derived,
                       now.activity);
  }
  return {};
}

}  // namespace

std::string FindViolation(const BehaviourCycle& cycle) {
  if (auto wrong = FindWrongNumber(cycle.now); !wrong.empty()) return wrong;
  if (auto unlimited = FindUnlimited(cycle); !unlimited.empty()) return unlimited;
  if (!cycle.before || !cycle.has_same_activities) return {};
  const bool is_at_rest = cycle.now.target_rating == 0.0 && cycle.before->target_rating == 0.0 &&
                          cycle.now.activation == cycle.before->activation;
  if (!is_at_rest || cycle.now.activity == cycle.before->activity) return {};
  return fmt::format("its activity has changed from {} to {} in the goal state (target rating 0, activation {})",
                     cycle.before->activity, cycle.now.activity, cycle.now.activation);
}

double CutRounding(double value, double most) {
  if (value > most && value <= most + kRoundingOfSignals) return most;
  if (value < 0.0 && value >= -kRoundingOfSignals) return 0.0;
  return value;
}

}  // namespace runnel

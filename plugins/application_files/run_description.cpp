#include "plugins/application_files/run_description.h"

#include <memory>

namespace runnel {

namespace {

template <typename Rule>
Result<void> AddAll(const std::vector<Placed<Rule>>& rules, Supervisor& supervisor) {
  for (const auto& [rule, position] : rules) {
    if (auto added = supervisor.Add(rule); !added) {
      Error error = added.error();
      error.position = position;
      return error;
    }
  }
  return {};
}

}  // namespace

std::vector<Placed<FaultRule>> FaultRulesOf(const FrameworkElement& application) {
  const auto* const rules = application.FindAnnotation<RunRules>();
  return rules != nullptr ? rules->fault_rules : std::vector<Placed<FaultRule>>{};
}

Result<void> AddSupervisionRules(const FrameworkElement& application, Supervisor& supervisor) {
  const auto* const rules = application.FindAnnotation<RunRules>();
  if (rules == nullptr) return {};
  if (auto added = AddAll(rules->stale_rules, supervisor); !added) return added;
  return AddAll(rules->fault_reactions, supervisor);
}

namespace internal {

FrameworkElement& ApplicationOf(FrameworkElement& element) {
  FrameworkElement* at = &element;
  while (at->parent()->parent() != nullptr) at = at->parent();
  return *at;
}

RunRules& RunRulesAround(FrameworkElement& element) {
  FrameworkElement& application = ApplicationOf(element);
  auto* const rules = application.FindAnnotation<RunRules>();
  return rules != nullptr ? *rules : application.Annotate(std::make_unique<RunRules>());
}

}  // namespace internal

}  // namespace runnel

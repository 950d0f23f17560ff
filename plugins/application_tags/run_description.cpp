#include "plugins/application_tags/run_description.h"

#include <memory>

namespace runnel {

Result<void> AddRules(const FrameworkElement& application, Scheduler& scheduler,
                      Supervisor& supervisor) {
  const auto* const rules = application.FindAnnotation<RunRules>();
  if (rules == nullptr) return {};
  for (const auto& [of, after] : rules->stuck_limits) (void)scheduler.SetStuckLimit(of, after);
  for (const SupervisionRule& rule : rules->rules) {
    if (auto added = supervisor.Add(rule); !added) return added;
  }
  for (const StopButtonRule& rule : rules->stop_buttons) {
    if (auto added = supervisor.Add(rule); !added) return added;
  }
  for (const LatencyRequest& each : rules->latencies) {
    if (auto added = scheduler.AddLatency(each); !added) return added;
  }
  if (rules->is_profiled) scheduler.SetProfiled(true);
  return {};
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

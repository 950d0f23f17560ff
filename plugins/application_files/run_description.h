#pragma once

#include <vector>

#include "core/base/error.h"
#include "core/element/annotation.h"
#include "core/element/framework_element.h"
#include "plugins/scheduling/fault.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/supervision/supervisor.h"

namespace runnel {

// What an application file says of how the application is run. It has been checked; paths in it are absolute.

template <typename Rule>
struct Placed {
  Rule rule;
  SourcePosition position;  ///< where the file says so
};

/// Kept with the application by <on_fault> and <on_stale>; in the order of the file.
struct RunRules final : Annotation {
  std::vector<Placed<FaultRule>> fault_rules;
  std::vector<Placed<FaultReaction>> fault_reactions;
  std::vector<Placed<StaleRule>> stale_rules;
};

/// What <clock> says; without it, the defaults of SchedulerOptions.
[[nodiscard]] SchedulerOptions SchedulerOptionsOf(const FrameworkElement& application);

[[nodiscard]] std::vector<Placed<FaultRule>> FaultRulesOf(const FrameworkElement& application);
/// Adds the rules of silence, and what is done about faults besides, to `supervisor`. The error has the place.
Result<void> AddSupervisionRules(const FrameworkElement& application, Supervisor& supervisor);

namespace internal {

/// The application that `element` is part of: what is directly below the root.
[[nodiscard]] FrameworkElement& ApplicationOf(FrameworkElement& element);
[[nodiscard]] RunRules& RunRulesAround(FrameworkElement& element);

}  // namespace internal

}  // namespace runnel

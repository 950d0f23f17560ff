#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/element/annotation.h"
#include "core/element/framework_element.h"
#include "core/xml/xml_document.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/supervision/supervisor.h"

namespace runnel {

// What an application file says of how the application is run. It has been checked; paths in it are absolute.

/// Kept with the application by <on_fault>, <on_stale>, <on_stuck>, <on_pause>, <stop_button>, <operators>,
/// <latency> and <profile>; in the order of the file.
struct RunRules final : Annotation {
  std::vector<SupervisionRule> rules;
  std::vector<StopButtonRule> stop_buttons;
  std::vector<LatencyRequest> latencies;
  /// Of the application and of threads; the path of the application is left out.
  std::vector<std::pair<std::string, Duration>> stuck_limits;
  bool is_profiled = false;
  /// So long all operators may be silent (OperatorWatch); nothing: for ever.
  std::optional<Duration> operators_timeout;
};

/// What <clock> says; without it, the defaults of SchedulerOptions.
[[nodiscard]] SchedulerOptions SchedulerOptionsOf(const FrameworkElement& application);

/// The same of what has only been parsed: whether its <clock> says another time than the machine's.
[[nodiscard]] bool LivesInSimulatedTime(XmlElement application);

/// Hands over the application's rules. The error, of a rule of silence, has the place.
Result<void> AddRules(const FrameworkElement& application, Scheduler& scheduler, Supervisor& supervisor);

namespace internal {

/// The application that `element` is part of: what is directly below the root.
[[nodiscard]] FrameworkElement& ApplicationOf(FrameworkElement& element);
[[nodiscard]] RunRules& RunRulesAround(FrameworkElement& element);

}  // namespace internal

}  // namespace runnel

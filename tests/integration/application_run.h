#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/clock.h"
#include "core/element/runtime.h"
#include "core/module/run_monitor.h"
#include "modules/types/algorithm/pose.h"
#include "plugins/scheduling/fault.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/structure/change_history.h"
#include "plugins/supervision/supervisor.h"

namespace runnel::test {

/// What those of the tests find who do more to an application than run it.
struct RunningApplication {
  Runtime& runtime;
  FrameworkElement& application;
  Scheduler& scheduler;
  ChangeHistory& history;
  Supervisor& supervisor;
};

/// An application file, run from the first cycle to its verdict on simulated time.
struct ApplicationRun {
  std::optional<RunOutcome> outcome;  ///< nothing if the time limit came first, or a fault's stop
  std::vector<Pose2> truth;           ///< where the robot really was, after each cycle
  std::vector<Fault> faults;
  std::vector<Notice> notices;                             ///< of what was done about faults and silence
  bool was_stopped = false;                                ///< by a fault rule
  std::vector<std::pair<Duration, std::string>> warnings;  ///< and errors of the log, since the start
  Duration duration{};
};

/// xml/apps/<name>. `replace` puts other words into the file first (a planner in place of
/// another), `arguments` are those of the command line ("goal_x=4"). Throws
/// std::runtime_error with all errors if the application cannot be built.
struct ApplicationChoice {
  std::string name;
  std::vector<std::pair<std::string, std::string>> replace = {};
  std::vector<std::string> arguments = {};
  Duration limit = std::chrono::hours(1);
  std::function<void()> before_step = {};  ///< of the scheduler: for probes
  std::function<void()> after_step = {};
  /// Before each step, with the time that has passed: for those who do more than change the structure.
  std::function<void(RunningApplication& run, Duration passed)> each_step = {};
  /// Applied one after the other, each when so much time has passed. Throws if one is refused.
  std::vector<std::pair<Duration, ChangeSet>> changes = {};
};
[[nodiscard]] ApplicationRun RunApplication(const ApplicationChoice& choice);

/// Builds it, makes it ready, and has `use` do what it likes with it; on the clock that its file says, once `replace` has
/// been done. Throws as RunApplication().
void UseApplication(const ApplicationChoice& choice, const std::function<void(RunningApplication& run)>& use);

}  // namespace runnel::test

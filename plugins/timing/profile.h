#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/module/executable.h"
#include "plugins/timing/latency_chain.h"
#include "plugins/timing/task_meter.h"

namespace runnel {

/// One task of a module, and how long its runs have taken since the measuring began.
struct ProfiledTask {
  std::string path;    ///< of the module
  std::string thread;  ///< of its container
  Phase phase = Phase::kUpdate;
  std::size_t order = 0;  ///< in its thread's cycle; 1: the first
  TaskTimes times;

  /// "/robot/base sense"; the path alone of modules that only update.
  [[nodiscard]] std::string name() const;
};

/// What has been measured of an application.
struct Profile {
  std::vector<ProfiledTask> tasks;  ///< thread by thread, in the order in which they run
  std::vector<Latency> latencies;
};

/// A profile as a table, for people. Shares are of `passed`, of the machine's time: of `since`, what has been added
/// since that was taken; those with the largest come first.
[[nodiscard]] std::string ProfileText(const Profile& profile, Duration passed, const Profile& since = {});

}  // namespace runnel

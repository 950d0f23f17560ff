#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <string>
#include <vector>

#include "core/base/call_stack.h"
#include "core/base/error.h"
#include "plugins/real_time_check/real_time_hooks.h"
#include "plugins/scheduling/task_watch.h"

namespace runnel {

/// Something that a module has done in its cycle and should not have, at one place of its code.
struct RealTimeBreach {
  RealTimeOffence offence = RealTimeOffence::kAllocation;
  std::string what;         ///< "malloc", "pthread_mutex_lock", "system call 1"
  std::uint64_t times = 0;  ///< that it was done there
  CallStack stack = {};     ///< from the module's task inwards

  /// "allocates in its cycle (malloc, 12 times):" and a line for each call.
  [[nodiscard]] std::string ToString() const;
};

/// What one module has done.
struct RealTimeBreaches {
  std::string path;
  std::vector<RealTimeBreach> breaches;
  std::uint64_t others = 0;  ///< at further places than are remembered
};

/// Watches whether tasks allocate, lock or call the system in their cycles, and remembers where.
///
/// Threads:     tasks run as they always do; Breaches() while none runs. Must outlive them all.
/// Allocation:  when tasks are made known; none in cycles.
class RealTimeWatch final : public TaskWatch {
 public:
  /// What a task does in its first cycles is not held against it: pools grow, buffers find their size.
  explicit RealTimeWatch(const RealTimeHooks& hooks, std::uint64_t first_cycles = 0);
  ~RealTimeWatch() override;

  [[nodiscard]] std::unique_ptr<WatchedTask> Watch(const Task& task) override;

  /// In the order in which their modules became known; without those that did nothing.
  [[nodiscard]] std::vector<RealTimeBreaches> Breaches() const;

 private:
  class Record;
  class Watched;

  const RealTimeHooks& hooks_;
  const std::uint64_t first_cycles_;
  std::list<Record> records_;  // one for each task
};

}  // namespace runnel

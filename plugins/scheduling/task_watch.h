#pragma once

#include <memory>

#include "core/module/executable.h"

namespace runnel {

/// A task with something before it and after it.
class WatchedTask {
 public:
  virtual ~WatchedTask() = default;
  /// Runs the task, and lets through what it throws. In a cycle, by the thread whose cycle has the element.
  virtual void Run() = 0;
};

/// Who wants to be there whenever a task runs. Schedules are made with what it makes of the tasks, so where nobody
/// watches, cycles pay nothing for it. Must outlive the scheduler and the runtime.
class TaskWatch {
 public:
  /// What is to be run in the place of `task`, and runs it. Lives as long as a cycle may run it. Under the
  /// structure lock.
  [[nodiscard]] virtual std::unique_ptr<WatchedTask> Watch(const Task& task) = 0;

 protected:
  virtual ~TaskWatch() = default;
};

}  // namespace runnel

#pragma once

#include <deque>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/base/clock.h"
#include "core/lockfree/wake_event.h"
#include "plugins/genom_execution/engine.h"

namespace runnel::genom_standalone {

/// A thread for the control task and one for each other task, by the machine's clock.
class TaskThreads {
 public:
  explicit TaskThreads(std::size_t tasks) : wakes_(tasks + 1) {}
  /// Preconditions: Begin() was called, and the engine ends or has ended.
  ~TaskThreads() { Join(); }
  TaskThreads(const TaskThreads&) = delete;
  TaskThreads& operator=(const TaskThreads&) = delete;

  void Begin(genom_execution::Engine& engine);
  /// Something has happened: EngineOptions::wake. Any thread.
  void WakeAll() noexcept;
  void Join();

 private:
  void RunControl(genom_execution::Engine& engine);
  void RunTask(genom_execution::Engine& engine, std::size_t task);

  SteadyClock clock_;
  std::deque<WakeEvent> wakes_;  // of the control task, then of the others
  std::vector<std::thread> threads_;
};

}  // namespace runnel::genom_standalone

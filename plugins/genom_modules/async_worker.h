#pragma once

#include <atomic>
#include <thread>

#include "core/lockfree/wake_event.h"
#include "plugins/genom_execution/codel_runner.h"

namespace runnel::genom_modules {

/// A thread that runs the asynchronous codels of one task, one at a time.
///
/// Threads: Begin() and WaitUntilBack() by the task's.
class AsyncWorker {
 public:
  AsyncWorker() : thread_([this](const std::stop_token& stop) { Run(stop); }) {}
  ~AsyncWorker();
  AsyncWorker(const AsyncWorker&) = delete;
  AsyncWorker& operator=(const AsyncWorker&) = delete;

  void Begin(genom_execution::AsyncWork& work) noexcept;
  /// Not in a cycle, but on a simulated clock.
  void WaitUntilBack() noexcept;
  /// At most until then, by the machine. False: it is still away.
  [[nodiscard]] bool WaitUntilBack(Time deadline) noexcept;

 private:
  void Run(const std::stop_token& stop);

  // release by who gives or has done the work, acquire by who looks.
  std::atomic<genom_execution::AsyncWork*> work_{nullptr};
  WakeEvent given_;
  WakeEvent back_;
  std::jthread thread_;  // last: uses all of it
};

}  // namespace runnel::genom_modules

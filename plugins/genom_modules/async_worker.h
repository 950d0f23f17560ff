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
  ~AsyncWorker() {
    thread_.request_stop();
    given_.Notify();
  }
  AsyncWorker(const AsyncWorker&) = delete;
  AsyncWorker& operator=(const AsyncWorker&) = delete;

  void Begin(genom_execution::AsyncWork& work) noexcept {
    work_.store(&work, std::memory_order_release);
    given_.Notify();
  }
  /// Not in a cycle, but on a simulated clock.
  void WaitUntilBack() noexcept {
    while (is_away()) back_.Wait();
  }
  /// At most until then, by the machine. False: it is still away.
  [[nodiscard]] bool WaitUntilBack(Time deadline) noexcept {
    while (is_away() && SteadyClock().Now() < deadline) back_.WaitUntil(deadline);
    return !is_away();
  }

 private:
  [[nodiscard]] bool is_away() const noexcept { return work_.load(std::memory_order_acquire) != nullptr; }
  void Run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      given_.Wait();
      genom_execution::AsyncWork* const work = work_.load(std::memory_order_acquire);
      if (work == nullptr) continue;
      work->Run();
      work_.store(nullptr, std::memory_order_release);
      back_.Notify();
    }
  }

  // release by who gives or has done the work, acquire by who looks.
  std::atomic<genom_execution::AsyncWork*> work_{nullptr};
  WakeEvent given_;
  WakeEvent back_;
  std::jthread thread_;  // last: uses all of it
};

}  // namespace runnel::genom_modules

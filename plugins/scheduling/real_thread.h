#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <thread>

#include <pthread.h>

#include "core/base/error.h"
#include "plugins/scheduling/cycle_runner.h"

namespace runnel {

/// Asks the system for what a real-time thread needs. None of it is needed to run: what is not
/// permitted comes back as a warning, and the thread runs all the same, less punctually.

/// Puts `thread` under SCHED_FIFO; with 0 under ordinary scheduling. Precondition: 0 <= priority <= 99.
[[nodiscard]] std::optional<Error> UseScheduling(pthread_t thread, int priority);

/// Keeps the memory of the process from being paged out. Memory that is allocated later is included
/// only where that cannot make allocations fail: without a limit on locked memory.
[[nodiscard]] std::optional<Error> LockMemory();

/// Touches the part of the calling thread's stack that its cycles will use, so that they meet no
/// page that is not there yet. Call at the start of the thread.
void PrefaultStack() noexcept;

/// A thread of the system that runs the cycles of one container on the machine's clock.
///
/// Threads:  made, asked to stop and joined by one thread. Allocation: none in the loop.
class RealThread {
 public:
  /// Starts at once; the first cycle of a periodic thread is due at `first`. `faults` must outlive
  /// this.
  RealThread(std::shared_ptr<CycleRunner> runner, FaultDispatcher& faults, Time first);
  /// Stops and joins.
  ~RealThread();

  [[nodiscard]] const std::shared_ptr<CycleRunner>& runner() const noexcept { return runner_; }
  /// Puts it under the real-time scheduling that its container asks for.
  [[nodiscard]] std::optional<Error> Prioritize();
  /// Has its cycles begin as its container says by now. Under the structure lock.
  void FollowActivation() noexcept;
  /// Lets the current cycle be the last, and does not wait for its end.
  void RequestStop() noexcept;
  /// True when joining will not take long.
  [[nodiscard]] bool has_ended() const noexcept { return ended_.load(std::memory_order_acquire); }

 private:
  void Run(Time first);
  void RunCycles(Time first);
  void RunPeriodically(Time first);
  void RunFreely();
  void RunOnData();
  [[nodiscard]] bool stopping() const noexcept { return stopping_.load(std::memory_order_acquire); }
  // It stops, or cycles begin otherwise from now on.
  [[nodiscard]] bool leaves() const noexcept { return leaves_.load(std::memory_order_acquire); }

  const std::shared_ptr<CycleRunner> runner_;
  int priority_ = 0;                      // as last asked for
  ThreadOptions::Activation activation_;  // likewise
  FaultDispatcher& faults_;
  std::atomic<bool> stopping_{false};
  std::atomic<bool> leaves_{false};  // set after what it is about, looked at after it is taken back
  std::atomic<bool> ended_{false};
  std::thread thread_;  // last: everything is there when it starts
};

}  // namespace runnel

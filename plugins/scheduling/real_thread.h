#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <thread>

#include "core/base/error.h"
#include "plugins/scheduling/cycle_runner.h"

namespace runnel {

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
  int priority_ = 0;  // as last asked for
  ThreadOptions::Activation activation_;  // likewise
  FaultDispatcher& faults_;
  std::atomic<bool> stopping_{false};
  std::atomic<bool> leaves_{false};  // set after what it is about, looked at after it is taken back
  std::atomic<bool> ended_{false};
  std::thread thread_;  // last: everything is there when it starts
};

}  // namespace runnel

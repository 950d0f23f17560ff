#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/base/clock.h"
#include "plugins/scheduling/cycle_runner.h"
#include "plugins/scheduling/thread_options.h"
#include "plugins/timing/tick_clock.h"

namespace runnel {

/// Runs all thread containers in one thread, in simulated time: always the cycle that is due next,
/// of those due at the same time the one of the container that was made first. What data has come
/// for runs right after the cycle that published them, at the same simulated time. Nothing depends
/// on the machine's clock: the same application computes the same, bit for bit.
///
/// Threads:  one at a time.
class SimulatedExecutor {
 public:
  explicit SimulatedExecutor(FaultDispatcher& faults) : faults_(faults) {}

  [[nodiscard]] const ManualClock& clock() const noexcept { return clock_; }
  [[nodiscard]] ManualClock& clock() noexcept { return clock_; }

  /// Runs these from now on, in this order. New ones are due at once, the others when they were.
  void SetRunners(const std::vector<std::shared_ptr<CycleRunner>>& runners);

  /// Time begins there, and all are due then.
  void BeginAt(Time first);
  /// Their periods may be others now.
  void FollowOptions();

  /// When something is to be run next: now, if data waits for a module; nullopt if nothing ever.
  [[nodiscard]] std::optional<Time> NextDue();
  /// Moves the clock to NextDue() and runs the one cycle, and what its data sets off. Ends early
  /// when a fault rule asks for the application to be stopped. False if there is nothing to run.
  bool Step();

  /// How many cycles data may set off at one and the same time. Modules that set each other off for
  /// ever are reported as a fault of their thread, and go on after the next periodic cycle.
  static constexpr int kMostTriggeredCycles = 1000;

 private:
  struct PeriodicThread {
    std::shared_ptr<CycleRunner> runner;
    DueTime due;
  };

  [[nodiscard]] PeriodicThread* NextPeriodic();
  [[nodiscard]] CycleRunner* NextActivated() const;
  void RunCycle(CycleRunner& runner, const Cycle& cycle);
  void RunPeriodic(PeriodicThread& thread);
  void RunActivated();
  void ReportEndlessLoop(const CycleRunner& runner);

  FaultDispatcher& faults_;
  ManualClock clock_;
  TickClock machine_;  // for the execution times alone
  std::vector<PeriodicThread> periodic_;
  std::vector<std::shared_ptr<CycleRunner>> waiting_;
  bool is_time_stuck_ = false;  // what data set off did not come to an end
  bool endless_loop_is_reported_ = false;
};

}  // namespace runnel

#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "core/base/ordered_mutex.h"
#include "core/element/runtime.h"
#include "plugins/scheduling/backpressure.h"
#include "plugins/scheduling/cycle_hold.h"
#include "plugins/scheduling/cycle_watchdog.h"
#include "plugins/scheduling/fault.h"
#include "plugins/scheduling/fault_dispatcher.h"
#include "plugins/scheduling/pace.h"
#include "plugins/scheduling/real_thread.h"
#include "plugins/scheduling/schedule_compiler.h"
#include "plugins/scheduling/simulated_executor.h"
#include "plugins/scheduling/thread_container.h"
#include "plugins/timing/profile.h"

namespace runnel {

class CycleTracer;
class TaskWatch;

struct SchedulerOptions {
  enum class ClockKind {
    kReal,       ///< threads of the system, on the machine's clock: Start(), Stop()
    kSimulated,  ///< one thread, on a clock that jumps from cycle to cycle: Step(), RunUntil()
  };

  ClockKind clock = ClockKind::kReal;
  /// kSimulated: how many times faster than real time it may go; 0: as fast as it can.
  double speed = 0;
  /// kSimulated: begins with a pause (Pace).
  bool is_paused = false;
  /// kSimulated: time passes as Pace::SetTime() says, from another simulator or ROS's /clock.
  bool follows_outside_clock = false;
  /// Path of the output that says it instead, of type double (seconds) or int64 (nanoseconds); what publishes there is
  /// no cycle of this scheduler's. "": none.
  std::string clock_port = {};
  /// kReal: lock the memory of the process, if any thread has a priority.
  bool lock_memory = true;
  /// Name of the container for what is assigned to none; "" or unknown: the one made first.
  std::string default_thread = {};
  /// Has it written down what cycles do. Must outlive the scheduler and the runtime. nullptr: nobody.
  CycleTracer* tracer = nullptr;
  /// Is there whenever a task runs. Must outlive both, too. nullptr: nobody.
  TaskWatch* watch = nullptr;
  /// Has RunningModulePath() know what runs, for who answers crashes.
  bool notes_running_tasks = false;
  /// If there is something to run but no container, one called "main" is made with these.
  ThreadOptions default_options = {};
};

/// Runs an application: finds everything in the tree that has tasks (Executable) and is ready,
/// brings it into the order of the data flow, and has it run by its thread containers. Follows
/// every change of the structure, also while running: a change takes effect from the next cycle on.
///
/// Ownership:  must be destroyed before the runtime. One per runtime.
/// Threads:    Start, Stop, Step, RunUntil and NextDue from one thread at a time, outside of cycles
///             and without the structure lock; the rest from any thread outside of cycles.
/// Errors:     a module that throws fails, and does not run again; the rest runs on (TakeFaults()).
class Scheduler final : public ElementListener, public AssignmentListener {
 public:
  /// On a simulated clock, becomes the clock of the runtime.
  explicit Scheduler(Runtime& runtime, SchedulerOptions options = {});
  ~Scheduler();

  [[nodiscard]] const SchedulerOptions& options() const noexcept { return options_; }

  /// kReal: starts a thread for each container. What the system does not permit becomes a warning.
  /// Errors: a simulated clock; a module that nobody has made ready; a thread that the system does not give; nothing
  /// runs then.
  Result<void> Start();
  /// Ends all threads after their current cycle and waits for them, but not for one that a StuckRule has found stuck:
  /// that ends when its module returns, and Start() fails until then; so long waits who destroys this. Idempotent.
  void Stop();
  [[nodiscard]] bool is_running() const;

  /// How fast simulated time passes, and whether it does, also while it does.
  [[nodiscard]] Pace& pace() noexcept { return pace_; }

  /// kSimulated: runs the cycle that is due next and what its data sets off, as soon as the pace
  /// allows it. False, with nothing run, if there is nothing to run or the end has been requested.
  bool Step();
  /// kSimulated: when Step() would run something; nullopt if there is nothing to run.
  [[nodiscard]] std::optional<Time> NextDue();
  /// kSimulated: runs all cycles that are due before `end`, then sets the clock to it, no faster
  /// than the pace allows. False if a stop was requested: the clock then stays at the cycle that
  /// was the last.
  bool RunUntil(Time end);
  /// What has come of Advance().
  enum class StepResult {
    kCycle,    ///< one has run, and what its data set off
    kEnd,      ///< the clock shows `end`, or there is nothing to run and no end
    kTimeout,  ///< the pace has not allowed it in time; ask again
    kStopped,  ///< the end of the run has been requested
  };
  /// kSimulated: one Step() of a RunUntil(end), for those who have other things to do meanwhile: waits
  /// for the pace no longer than `timeout` of the machine's clock.
  StepResult Advance(std::optional<Time> end, Duration timeout);
  /// kSimulated: tests may move it between cycles, and inside of them to let a cycle take time.
  [[nodiscard]] ManualClock& simulated_clock() noexcept { return simulation_.clock(); }

  /// By a fault rule, or by RequestStop(). The program that runs the application looks at it and
  /// calls Stop(); until then real threads run on, so that what else is there can bring the robot
  /// to rest. A request that comes before Start() holds; only when started again after a Stop()
  /// does the scheduler forget that of the run before.
  [[nodiscard]] bool stop_requested() const noexcept { return faults_.stop_requested(); }
  /// A fault rule has requested it, whoever else has, too.
  [[nodiscard]] bool ended_by_fault() const noexcept { return faults_.ended_by_fault(); }
  /// Any thread, also from a signal handler.
  void RequestStop() noexcept { faults_.RequestStop(); }

  /// The faults since the last call, oldest first. While real threads run, those that the
  /// supervising thread has not attended to yet come with a later call.
  [[nodiscard]] std::vector<Fault> TakeFaults();
  /// The same, behind what is there. Errors: no memory; nothing is taken.
  void TakeFaults(std::vector<Fault>& to);
  void AddFaultRule(FaultRule rule) { faults_.AddRule(std::move(rule)); }

  /// Whether any thread has anything to run. Brings the schedules up to date.
  [[nodiscard]] bool HasTasks();

  /// What a person should know of the application as it stands: loops that were cut, modules that
  /// never run, that have not been made ready, or that name no thread where there are several, and, once started, real-time rights
  /// that are missing. Brings the schedules up to date.
  [[nodiscard]] std::vector<Error> Warnings();

  /// Has rules and measurements lead where they have led before, as something has got another name: `move` is called with
  /// each path. Under the structure lock.
  void MovePaths(const std::function<void(std::string& path)>& move);

  /// Keeps the threads that run anything at or below one of `paths` between two of their cycles, so
  /// that what is changed until the hold goes takes effect as a whole. Errors, threads: see CycleHold;
  /// not under the structure lock. A thread that a StuckRule has found stuck is not waited for: an error if it runs
  /// anything of `at_rest`; else it is left out.
  Result<CycleHold> HoldCycles(const std::vector<std::string>& paths, Duration timeout,
                               const std::vector<std::string>& at_rest);
  Result<CycleHold> HoldCycles(const std::vector<std::string>& paths, Duration timeout) {
    return HoldCycles(paths, timeout, paths);
  }
  /// Of the thread that runs the element; nullopt if none does.
  struct Progress {
    std::uint64_t cycles = 0;  ///< that have begun
    bool has_failed = false;   ///< the element has thrown
  };
  [[nodiscard]] std::optional<Progress> ProgressOf(const std::string& path);

  /// Names modules that do not return from their cycles in time; see CycleWatchdog. On a simulated clock the watchdog's
  /// thread does what the rule says, as the one that steps is stuck.
  void AddStuckRule(StuckRule rule);
  /// Names all at or below `of` that take longer than `after`; "": all that no other rule is about; zero: no more.
  /// Errors: a negative time.
  Result<void> SetStuckLimit(const std::string& of, Duration after);
  [[nodiscard]] std::vector<StuckRule> StuckRules() const { return cycle_watchdog_.rules(); }
  /// Those that are stuck now, also after Stop().
  [[nodiscard]] std::vector<StuckModule> StuckModules() const { return cycle_watchdog_.Stuck(); }
  /// kSimulated: is called again and again while a module is stuck, by another thread than the one that steps, which
  /// cannot. Waits for a call that is under way.
  void SetStuckListener(std::function<void()> listener);

  /// How long each task takes is measured from now on, or no more unless a ProfileUse lives. What is measured begins at
  /// nothing whenever the measuring begins.
  void SetProfiled(bool is_profiled);
  /// Has it measured while it lives; the scheduler outlives it.
  class ProfileUse {
   public:
    explicit ProfileUse(Scheduler& scheduler);
    ~ProfileUse();
    ProfileUse(const ProfileUse&) = delete;
    ProfileUse& operator=(const ProfileUse&) = delete;

   private:
    Scheduler& scheduler_;
  };
  /// Since when, if it is measured.
  [[nodiscard]] std::optional<Duration> profiled_for() const;
  /// No tasks if nothing is measured. Takes the structure lock, as all of these.
  [[nodiscard]] Profile ReadProfile();

  /// Measures how old what `to` publishes is, along the modules in between, also after those are replaced. Errors: no
  /// such port, no data flow.
  Result<void> AddLatency(const LatencyRequest& request);
  /// Errors: there is none between these two.
  Result<void> RemoveLatency(const LatencyRequest& request);
  [[nodiscard]] std::vector<Latency> ReadLatencies();

  /// Leaves all at or below the path out of cycles, on either clock, or all that a thread of this path runs; what comes
  /// there later, too. It is kept with the element: other names, replacements, undoing and copies have it, too. When it returns none of them runs any more, but for one that a StuckRule has found stuck. Not
  /// within a cycle, nor under the structure lock. Errors: no such element; a cycle that does not end in 5 s.
  Result<void> SetPaused(std::string_view path, bool is_paused);
  [[nodiscard]] std::vector<std::string> PausedPaths() const;
  /// Whether cycles leave out any module at or below the element; what this path pauses does not count, if it is given.
  [[nodiscard]] bool IsPaused(FrameworkElement& element, std::string_view but_for = {}) const;
  /// Of the cycles of each thread so far, by its path. Under the structure lock.
  using StatisticsVisitor = std::function<void(const std::string& path, const CycleStatistics& all)>;
  void VisitThreadStatistics(const StatisticsVisitor& visit) const;
  /// Why nothing new comes from the module that has the element, as "/planner is paused": it has failed, or its thread is
  /// stuck. "": it runs. Under the structure lock.
  [[nodiscard]] std::string WhyAtRest(const FrameworkElement& element, Duration patience = Duration::max()) const;
  /// Why nobody reads a driving port, so that no STOP reaches it either: as WhyAtRest() of a module that reads it, but for
  /// a thread that is stuck at once after kUnreachedAfter. `sinks`: its own. "": it is read. Under the structure lock.
  static constexpr Duration kUnreachedAfter = std::chrono::milliseconds(500);
  [[nodiscard]] std::string WhyUnreached(const Port& port, std::span<Port* const> sinks) const;
  [[nodiscard]] std::string WhyUnreached(const Port& port) const { return WhyUnreached(port, port.Sinks()); }
  /// Has the module that has the element run soon, if its thread waits for data: of what is old nothing tells it. Under the
  /// structure lock.
  void WakeWithoutData(const FrameworkElement& element) const;
  /// Errors: no such element; it is not this path that has been paused.
  [[nodiscard]] Result<void> CheckPaused(std::string_view path) const;

  /// Is asked first about each fault, outside of cycles and without locks, and returns at once. What it returns is called,
  /// kReal by a thread of its own, and may take long; what it says it has done is added to the fault's
  /// message, and no rule is applied then. nullptr: not its business. Who throws std::bad_alloc is asked again.
  using FaultHandler = FaultDispatcher::Handler;
  void SetFaultHandler(FaultHandler handler) { faults_.SetHandler(std::move(handler)); }

  /// Is called between cycles, without locks, and returns the time, by the runtime's clock, before
  /// which it need not be called again: kReal by the supervising thread, kSimulated after the first
  /// cycle that ends then or later. Set it while nothing runs.
  using Watchdog = std::function<Time(Time now)>;
  void SetWatchdog(Watchdog watchdog);
  /// kSimulated: what may hold simulated time back between cycles; on a real clock it is never asked.
  [[nodiscard]] Backpressure& backpressure() noexcept { return backpressure_; }
  /// As a fault rule does: stop_requested() and ended_by_fault() become true.
  void EndForFault() noexcept { faults_.EndForFault(); }

  void OnReady(FrameworkElement& element) override;
  void OnDeleted(FrameworkElement& element) override;
  void OnConnected(FrameworkElement& from, FrameworkElement& to) override;
  void OnDisconnected(FrameworkElement& from, FrameworkElement& to) override;
  void OnAssigned(FrameworkElement& element) override;
  void OnOptionsChanged(ThreadContainer& thread) override;
  void OnChangesEnd() override;

 private:
  using Runners = std::vector<std::shared_ptr<CycleRunner>>;
  using RealThreads = std::vector<std::unique_ptr<RealThread>>;

  // Under start_mutex_.
  [[nodiscard]] std::optional<Error> NeverReady() const;
  void StartAll();
  bool EndAll() noexcept;

  void EndThreads(RealThreads& threads) noexcept;
  void UpdateInstruments();
  void BeginOrEndProfile();
  Result<std::shared_ptr<LatencyChain>> MakeChain(const LatencyRequest& request);
  static void FollowPath(const DataPath& path, LatencyChain& chain);
  void FollowChains();
  void TieChains();
  void NoteChainChange() noexcept { have_chains_changed_ = !chains_.empty(); }

  [[nodiscard]] Runners RunnersOf(const std::vector<std::string>& paths);

  // Simulated clock.
  void FollowChanges();
  void LookAtClockPort();
  void TellJump();
  [[nodiscard]] bool FollowOutsideClock();
  void ShowOutsideTime();

  // All under the structure lock.
  // Whether a cycle may begin at any time.
  [[nodiscard]] bool is_live() const noexcept { return is_running_ || has_stepped_; }
  [[nodiscard]] bool is_up_to_date() const noexcept {
    return !compiler_.needs_all() && !compiler_.has_changes() && !have_chains_changed_;
  }
  void Changed();
  void BringUpToDate();
  void StartThreads(Time first);

  void Supervise();
  void Maintain() noexcept;
  void RunWatchdog() noexcept;
  void EndSupervision();

  Runtime& runtime_;
  const SchedulerOptions options_;
  const Clock& clock_before_;  // the runtime's, before ours
  FaultDispatcher faults_;
  SimulatedExecutor simulation_{faults_};
  SteadyClock machine_;
  CycleWatchdog cycle_watchdog_;
  Pace pace_;
  Backpressure backpressure_;

  OrderedMutex start_mutex_{LockLevel::kScheduler};
  bool has_run_ = false;  // until started again; guarded by start_mutex_
  // Guarded by the structure lock, down to the next comment:
  ScheduleCompiler compiler_;
  bool has_other_runners_ = true;  // than threads or lanes have been made for
  bool is_running_ = false;
  bool has_stepped_ = false;
  Runners runners_;
  std::vector<Error> realtime_warnings_;
  RealThreads threads_;
  RealThreads ending_;                       // their containers are gone, or their modules have not returned
  bool is_profiled_ = false;                 // whether or not somebody uses it
  std::atomic<int> profile_uses_{0};         // whoever goes waits for no lock
  std::optional<Time> profile_began_;        // by the machine
  mutable std::vector<std::string> paused_;  // as of the structure's revision ...
  mutable std::uint64_t paused_at_ = ~std::uint64_t{};
  std::vector<std::shared_ptr<LatencyChain>> chains_;
  bool have_chains_changed_ = false;

  // Simulated clock: set under the structure lock when something has changed, and taken back under
  // it by the thread that steps, which need not lock where nothing has.
  std::atomic<bool> has_changes_{true};
  bool outside_clock_has_begun_ = false;
  std::string clock_port_ = options_.clock_port;  // under the structure lock, as it is called now

  Watchdog watchdog_;
  Time next_watch_{};  // by it
  std::atomic<bool> supervises_{false};
  std::thread supervisor_;
};

}  // namespace runnel

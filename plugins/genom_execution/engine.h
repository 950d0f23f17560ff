#pragma once

#include <atomic>
#include <deque>
#include <vector>

#include "core/lockfree/bounded_queue.h"
#include "plugins/genom_execution/execution_task.h"

namespace runnel::genom_execution {

/// Takes requests one at a time: checks and validates them, does what attributes and functions do, has activities
/// interrupted, started and answered.
///
/// Threads: Run() by one thread at a time; Send() by any.
class ControlTask {
 public:
  explicit ControlTask(Engine& engine);

  [[nodiscard]] bool Send(Request& request) noexcept;
  /// One pass: until nothing waits, or a codel may not run yet (kWaiting).
  Pass Run();
  /// Everything is to end, permanent activities in the reverse order of their tasks; true when all has.
  [[nodiscard]] bool ShutDown();

 private:
  enum class Step : std::uint8_t { kValidate, kAssign, kCodels, kInterrupt };

  [[nodiscard]] bool Reap();
  [[nodiscard]] bool StartPending();
  void Begin(Request& request);
  /// False: a codel may not run yet.
  [[nodiscard]] bool GoOn();
  [[nodiscard]] bool RunCodels(std::span<const std::uint16_t> codels);
  void Abort(Request& request);
  void Interrupt(ActivitySlot& slot, const char* by);
  void InterruptAll(const ServiceTable& service);
  void Finish(Request& request);
  void Free(ActivitySlot& slot);
  [[nodiscard]] ActivitySlot* FindFree(const ServiceTable& service);
  [[nodiscard]] bool MayStart(const ActivitySlot& slot) const;
  [[nodiscard]] bool IsAllowed(const ServiceTable& service) const;
  template <typename Use>
  void ForEachActivity(Use use);

  Engine& engine_;
  BoundedQueue<Request*> queue_;
  CodelRunner runner_;
  std::vector<bool> has_succeeded_;  // by services
  std::uint32_t next_id_ = 1;
  std::vector<ActivitySlot*> pending_;  // in the order of their acceptance
  // The request that is being looked at.
  Request* request_ = nullptr;
  ActivitySlot* slot_ = nullptr;  // of an activity
  Step step_ = Step::kValidate;
  std::size_t position_ = 0;   // among the codels of the step
  std::size_t shut_down_ = 0;  // tasks, from the last, whose permanent activity has been told to end
};

struct EngineOptions {
  void* ids = nullptr;          ///< of this instance; what a codel's Invocation has
  void* glue = nullptr;         ///< CodelContext::data, and the first argument of the functions below
  std::size_t activities = 32;  ///< of each task at once
  std::size_t requests = 64;    ///< that wait for the control task
  /// How long RunControl() and RunTask() may sleep until a codel may run: tasks with threads of their own. Then, and if
  /// it conflicts with one that another thread runs for them, they return kWaiting.
  Duration patience{};
  /// Whether one thread runs all tasks: then only asynchronous codels are kept apart from others.
  bool is_single_threaded = false;
  /// Has AsyncWork::Run() called by another thread: of the task of that place, 0 being the control task. nullptr: codels
  /// are called by the task's thread, which may take long.
  void (*run_async)(void* glue, std::size_t place, AsyncWork& work) = nullptr;
  /// Something has happened that tasks may want to see: whatever drives aperiodic ones and the control task should run
  /// them. Any thread. nullptr: they are run all the time.
  void (*wake)(void* glue) = nullptr;
  const Clock* clock = nullptr;  ///< by which time in codels is measured; nullptr: is not measured
};

/// A component at work, by the semantics of GenoM3: a control task, execution tasks, activities. It has no thread and no
/// clock: who owns it calls RunControl() and RunTask() for each task, again and again, by one thread or by one for each.
///
///     engine.Send(request);                       // any thread
///     engine.RunControl();                        // until kIdle, whenever something has happened
///     while (engine.RunTask(0, now) == Pass::kAgain) {}
///
/// Until all tasks have made their first pass, in their order, requests wait. After Stop() all activities are ended, then
/// the permanent ones in the reverse order of their tasks; goes on being run until is_ended().
///
/// Threads:     RunControl() by one thread at a time, RunTask() for each task by one; the rest by any.
/// Allocation:  in the constructor only.
/// Errors:      what a codel throws (no exception of its description, but a C++ one) comes out of the call that ran it;
///              the engine can then only be destroyed.
class Engine {
 public:
  Engine(const ComponentTable& component, const EngineOptions& options);

  /// False: too many requests wait.
  [[nodiscard]] bool Send(Request& request) noexcept;
  Pass RunControl();
  /// `is_forced`: also if a periodic task is not due, so that it comes to an end after Stop().
  Pass RunTask(std::size_t task, Time now, bool is_forced = false);
  /// Everything that can be done at this time, by one thread: the control task, and those tasks that are `its`. What never
  /// pauses goes on when it is called the next time.
  template <typename IsOne>
  void RunAll(Time now, bool is_forced, const IsOne& its) {
    for (int round = 0; round < kMostRounds; ++round) {
      const std::uint64_t before = changes();
      (void)RunControl();
      bool goes_on = false;
      for (std::size_t i = 0; i < tasks_.size(); ++i) goes_on |= its(i) && RunTask(i, now, is_forced) == Pass::kAgain;
      if ((!goes_on && changes() == before) || is_ended()) return;
    }
  }
  static constexpr int kMostRounds = 1000;
  /// All that is under way is to end.
  void Stop() noexcept;

  [[nodiscard]] bool is_stopping() const noexcept { return is_stop_asked_.load(std::memory_order_acquire); }
  [[nodiscard]] bool is_ended() const noexcept { return phase() == Phase::kEnded; }
  /// Of a permanent activity that has ended by an exception, the first one; nullptr: none. During the start it ends the
  /// component.
  [[nodiscard]] const Outcome* failure() const noexcept;
  /// Grows when something has happened that the control task or another task may want to see: they are worth running
  /// again.
  [[nodiscard]] std::uint64_t changes() const noexcept { return changes_.load(std::memory_order_acquire); }

  [[nodiscard]] const ComponentTable& component() const noexcept { return component_; }
  [[nodiscard]] const EngineOptions& options() const noexcept { return options_; }
  [[nodiscard]] std::deque<ExecutionTask>& tasks() noexcept { return tasks_; }

  /// Whether time in codels is measured, if there is a clock; it is at first. Any thread.
  void SetMeasured(bool is_measured) noexcept { is_measured_.store(is_measured, std::memory_order_relaxed); }

  /// The standard services that a component has whatever its middleware.
  [[nodiscard]] static const ServiceTable& AbortService();  ///< Request::abort_id
  [[nodiscard]] static const ServiceTable& KillService();

  // For the tasks.
  [[nodiscard]] const Clock* clock() const noexcept {
    return is_measured_.load(std::memory_order_relaxed) ? options_.clock : nullptr;
  }
  /// Something has happened that ends the pause of aperiodic tasks.
  void Note() noexcept {
    // release: pairs with the acquire in events(): what has happened is to be seen.
    events_.fetch_add(1, std::memory_order_release);
    Wake();
  }
  [[nodiscard]] std::uint64_t events() const noexcept { return events_.load(std::memory_order_acquire); }
  void Wake() noexcept {
    changes_.fetch_add(1, std::memory_order_release);
    if (options_.wake != nullptr) options_.wake(options_.glue);
  }
  void NoteFailure(const Outcome& outcome) noexcept;
  [[nodiscard]] Exclusion& exclusion() noexcept { return exclusion_; }
  [[nodiscard]] bool Excludes(std::size_t unit) const noexcept { return is_excluding_ && conflicts_.HasAny(unit); }
  /// Whether it is worth sleeping until this one may run.
  [[nodiscard]] bool IsWorthSleeping(std::size_t unit) const noexcept {
    return options_.patience > Duration::zero() && (options_.run_async == nullptr || !conflicts_.HasAsync(unit));
  }
  [[nodiscard]] bool HasBegun(const ExecutionTask& task) const noexcept;

 private:
  enum class Phase : std::uint8_t { kStarting, kRunning, kStopping, kEnded };
  [[nodiscard]] Phase phase() const noexcept { return phase_.load(std::memory_order_acquire); }

  const ComponentTable& component_;
  const EngineOptions options_;
  const ConflictMatrix conflicts_;
  const bool is_excluding_;
  Exclusion exclusion_;
  // release by the control task or the task that is being started; acquire by all.
  std::atomic<Phase> phase_{Phase::kStarting};
  std::atomic<std::size_t> starting_{0};  // which task makes its first pass
  std::atomic<bool> is_stop_asked_{false};
  std::atomic<bool> is_measured_{true};
  std::atomic<std::uint64_t> events_{1};
  std::atomic<std::uint64_t> changes_{1};
  std::atomic<const Outcome*> failure_{nullptr};
  std::deque<ExecutionTask> tasks_;
  ControlTask control_;
};

}  // namespace runnel::genom_execution

#pragma once

#include <array>
#include <atomic>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/channel/subscribers.h"
#include "core/lockfree/thread_epoch.h"
#include "core/lockfree/wake_event.h"
#include "core/module/module.h"
#include "core/port/output.h"
#include "plugins/genom_execution/codel_runner.h"
#include "plugins/genom_execution/component_table.h"
#include "plugins/genom_modules/component_service.h"
#include "plugins/genom_modules/component_state.h"
#include "plugins/parameters/parameter.h"

namespace runnel {
class ThreadContainer;
}

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

  void Begin(genom_execution::AsyncWork& work) noexcept {
    away_.fetch_add(1, std::memory_order_relaxed);
    work_.store(&work, std::memory_order_release);
    given_.Notify();
  }
  /// Not in a cycle, but on a simulated clock. At most until then, by the machine. False: it is still away.
  [[nodiscard]] bool WaitUntilBack(Time deadline) noexcept {
    while (is_away() && SteadyClock().Now() < deadline) back_.WaitUntil(deadline);
    return !is_away();
  }

 private:
  [[nodiscard]] bool is_away() const noexcept { return away_.load(std::memory_order_acquire) != 0; }
  void Run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      given_.Wait();
      // Taken before it runs: when it is done its task may at once give the next one.
      genom_execution::AsyncWork* const work = work_.exchange(nullptr, std::memory_order_acquire);
      if (work == nullptr) continue;
      work->Run();
      away_.fetch_sub(1, std::memory_order_release);
      back_.Notify();
    }
  }

  // release by who gives the work, acquire by who takes it.
  std::atomic<genom_execution::AsyncWork*> work_{nullptr};
  // How much is given and not done: changed by the task, then by the thread. release by who has done it, acquire by who looks.
  std::atomic<int> away_{0};
  WakeEvent given_;
  WakeEvent back_;
  std::jthread thread_;  // last: uses all of it
};

/// Who is set off when something has happened in a component, if triggers do.
///
/// Threads: SetWaker() under the structure lock, Wake() any.
class WakeTarget {
 public:
  /// Whether something waits is not known: it is set off at once, and finds out.
  void SetWaker(Waker* waker) noexcept {
    // acquire: pairs with the release in Wake(). Of both, which change the same word, one comes second: Wake() finds
    // the waker, or whom this wakes finds what has happened.
    (void)waker_.exchange(waker, std::memory_order_acq_rel);
    if (waker != nullptr) waker->Wake();
  }
  void Wake() noexcept {
    const EpochGuard guard;  // it is there until nobody is inside one that began before it was taken back
    Waker* waker = nullptr;
    // A change, though of nothing. release: pairs with the acquire in SetWaker().
    if (!waker_.compare_exchange_strong(waker, nullptr, std::memory_order_acq_rel)) waker->Wake();
  }

 private:
  std::atomic<Waker*> waker_{nullptr};
};

class ComponentModule;

/// An execution task of a component that another thread runs than that of the component's module: below the module, so
/// that schedules, pauses, figures and swaps know it. What its codels throw is the module's fault.
///
/// Errors: Prepare() says if there is no such thread, or if its period does not divide the task's.
class TaskModule final : public Module {
 public:
  /// `target`: of the component, which outlives it.
  TaskModule(const Placement& placement, ComponentModule& component, std::size_t number, std::string thread,
             WakeTarget& target);

 private:
  Result<void> Prepare() override;
  void Update() override;
  [[nodiscard]] Result<void> Check(const ThreadContainer& thread) const;

  ComponentModule& component_;
  const std::size_t number_;  // of the task
  const std::string thread_;
};

/// Of an input: when the values that codels have of it were measured, and who has read them. Threads: any; Note() one at a time.
struct PortReading {
  struct Slot {
    // relaxed, all: each tells of itself.
    std::atomic<Time> measured{Time::max()};
    std::atomic<const genom_execution::Request*> reader{nullptr};
    std::atomic<std::uint32_t> activity{0};  // the reader's: a service uses its requests again
  };
  std::array<Slot, 4> slots;

  /// Instead of what the same one has read before, or who has ended; else of the oldest one.
  void Note(const genom_execution::Request* reader, Time measured) noexcept;
};

/// A component as a module: what the template `runnel` makes derives from it and adds ids, ports, services and
/// parameters. Tasks run in the cycle of the module, each at its ticks, so the period of the module's thread divides
/// theirs; or in cycles of other threads of the application, which the parameters thread_of_TASK name (TaskModule). A
/// codel that conflicts with one that another thread is just running is then waited for. Asynchronous codels are run by
/// threads of their own; on a simulated clock the cycle waits for them, unless they call others, so that each run is
/// like the one before.
///
/// Life: the engine is there from Prepare() on, the `start` codels of the tasks run in the first cycles. The destructor
///       of the derived class calls End().
/// Errors: a `start` codel that raises an exception, or a permanent activity that ends by one, is the module's fault.
class ComponentModule : public Module {
 public:
  /// `ids` is a member of the derived class.
  ComponentModule(const Placement& placement, const genom_execution::ComponentTable& component, void* ids);

  [[nodiscard]] const genom_execution::ComponentTable& table() const noexcept { return component_; }
  [[nodiscard]] genom_execution::Engine& engine() noexcept { return *engine_; }
  void AddPart(ModulePart& part) { parts_.push_back(&part); }
  /// In constructors.
  void AddReading(const PortReading& reading) { readings_.push_back(&reading); }
  /// What a codel of `writer` publishes now is as old as the oldest measurement that it may have part in: read by its
  /// own activity or by a permanent one, in this cycle or before; for a permanent one, by any that is under way.
  [[nodiscard]] Time StampFor(const genom_execution::Request* writer) const noexcept;
  /// A call of a service has been successful.
  void AfterCall(genom_execution::Request& request) {
    for (ModulePart* part : parts_) part->AfterCall(request);
  }
  /// A part wants a cycle, also of a thread that waits for data.
  void Wake() noexcept { own_part_.target.Wake(); }
  /// One cycle of a task that another thread runs, by that thread.
  void RunOwnTask(std::size_t task, Time time) noexcept;
  using Module::log;

 protected:
  /// Derived classes that have their own call this one.
  Result<void> Prepare() override;
  void Update() override;
  /// Activities and tasks come to their end, as far as they do without time passing. Their answers are sent.
  void End() noexcept;

 private:
  /// What sets the module itself off.
  class OwnPart final : public CyclePart {
   public:
    explicit OwnPart(ComponentModule& module) : work_(CycleWork::Add(module, *this)) {}
    ~OwnPart() { work_->Remove(*this); }
    void BeforeUpdate() override {}
    void SetWaker(Waker* waker) override { target.SetWaker(waker); }
    WakeTarget target;

   private:
    CycleWork* const work_;
  };
  [[nodiscard]] genom_execution::EngineOptions Options();
  void MakeTasks();
  void CheckPeriods() const;
  void RunPasses(Time time, bool is_forced);
  void PublishState();
  /// Before another component takes its place: as End(), but it may be run again.
  void Settle();
  void EndActivities(Time deadline);
  void BeginAfresh();

  const genom_execution::ComponentTable& component_;
  void* const ids_;
  std::deque<StaticParameter<std::string>> thread_names_;  // by tasks
  std::optional<genom_execution::Engine> engine_;
  std::vector<ModulePart*> parts_;
  std::vector<const PortReading*> readings_;
  // By tasks: what wakes those that other threads run; none of those that run in the cycle of the module.
  std::vector<std::unique_ptr<WakeTarget>> own_tasks_;
  OwnPart own_part_{*this};
  std::vector<std::unique_ptr<AsyncWorker>> workers_;  // by places; none without asynchronous codels
  bool is_simulated_ = false;
  bool is_settled_ = false;  // it begins afresh if it is run again
  // Codels have run. relaxed: looked at when nothing runs any more.
  std::atomic<bool> has_run_{false};
  // A codel has thrown, and no other may run.
  std::atomic<bool> is_broken_{false};
  std::atomic_flag is_fault_taken_ = ATOMIC_FLAG_INIT;  // by the first of other threads, which writes it
  std::atomic<bool> has_fault_{false};                  // release, acquire: it is written
  std::string fault_;

 public:
  Output<ComponentState> genom_state;
  ComponentService<void()> kill;
  ComponentService<void(std::uint32_t)> abort_activity;
};

}  // namespace runnel::genom_modules

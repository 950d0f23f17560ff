#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "core/base/clock.h"
#include "core/lockfree/wake_event.h"
#include "core/port/cycle.h"
#include "plugins/scheduling/running_task.h"
#include "plugins/scheduling/schedule.h"
#include "plugins/scheduling/thread_options.h"
#include "plugins/timing/cycle_statistics.h"
#include "plugins/timing/tick_clock.h"

namespace runnel {

/// What is noted of cycles, beside their statistics, while they run: bits of a set. Without any, a cycle pays for one
/// branch.
struct Instruments {
  static constexpr std::uint8_t kTrace = 1;    ///< on the schedule's TraceTrack
  static constexpr std::uint8_t kRunning = 2;  ///< which element is just running
  static constexpr std::uint8_t kProfile = 4;  ///< how long each task takes
  static constexpr std::uint8_t kLatency = 8;  ///< how old what chains publish is
};

/// Runs the cycles of one thread container; both executors are built on it. It outlives the
/// container until its last cycle has ended.
///
/// Threads:     RunCycle() and Record() by one thread at a time; Install() under the structure
/// lock;
///              Activate() and statistics() from any thread.
/// Allocation:  none in RunCycle(), apart from what a module that throws makes itself.
class CycleRunner {
 public:
  CycleRunner(std::string path, const ThreadOptions& options)
      : path_(std::move(path)),
        activation_(options.activation),
        period_(options.period.count()),
        priority_(options.priority),
        on_overrun_(options.on_overrun) {}
  ~CycleRunner();

  /// Of its container.
  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  [[nodiscard]] ThreadOptions options() const noexcept {
    return {activation_.load(std::memory_order_relaxed), period(), priority_.load(std::memory_order_relaxed),
            on_overrun_.load(std::memory_order_relaxed)};
  }
  [[nodiscard]] Duration period() const noexcept {
    // relaxed: a number, which holds from some cycle on.
    return Duration(period_.load(std::memory_order_relaxed));
  }
  /// From one of the next cycles on. Under the structure lock; with another activation, a new schedule has to follow.
  void set_options(const ThreadOptions& options) noexcept {
    activation_.store(options.activation, std::memory_order_relaxed);
    period_.store(options.period.count(), std::memory_order_relaxed);
    priority_.store(options.priority, std::memory_order_relaxed);
    on_overrun_.store(options.on_overrun, std::memory_order_relaxed);
  }
  [[nodiscard]] bool waits_for_data() const noexcept {
    // relaxed: a cycle may still run by the one before; the lock orders it with Install().
    return activation_.load(std::memory_order_relaxed) == ThreadOptions::Activation::kTrigger;
  }

  /// What is noted from the next cycle on. Any thread.
  void set_instruments(std::uint8_t instruments) noexcept {
    instruments_.store(instruments, std::memory_order_relaxed);
  }
  /// Only with Instruments::kRunning.
  [[nodiscard]] const RunningTask& running() const noexcept { return running_; }
  /// Whose cycle the calling thread is in; nullptr: none, or nothing is noted of it. May be called by the handler of a
  /// signal.
  [[nodiscard]] static const CycleRunner* OfThisThread() noexcept;

  /// Takes effect from the next cycle on; a runner that waits for data has one at once if data have
  /// come for any element of the schedule.
  void Install(std::unique_ptr<const Schedule> schedule);
  /// Under the structure lock; nullptr before the first Install().
  [[nodiscard]] const Schedule* schedule() const noexcept { return schedule_.load(std::memory_order_seq_cst); }

  /// For the threads that others' schedules may have to wait for.
  [[nodiscard]] const std::shared_ptr<CycleQuiescence>& quiescence() const noexcept { return quiescence_; }

  /// By which others keep this runner between two cycles (CycleHold).
  [[nodiscard]] CycleGate& gate() noexcept { return gate_; }

  /// One cycle: every task in turn (of those that data has come for, if the thread waits for data).
  /// Returns false, with nothing run, if the gate is closed: wait until it is open, and try again.
  [[nodiscard]] bool RunCycle(Cycle cycle, FaultDispatcher& faults) noexcept;
  /// Counts a cycle that has ended.
  void Record(const CycleMeasurement& cycle) noexcept { meter_.Add(cycle); }
  /// How many cycles have begun.
  [[nodiscard]] std::uint64_t cycles_begun() const noexcept { return cycles_begun_.load(std::memory_order_relaxed); }
  [[nodiscard]] CycleStatistics statistics() const noexcept { return meter_.statistics(); }

  /// Data has come for an element of this runner. Within a cycle the waiting thread is woken at the
  /// cycle's end, if the cycle's schedule knows of it.
  void Activate() noexcept;
  /// Whether data has come since the last call.
  [[nodiscard]] bool TakeActivation() noexcept { return activated_.exchange(false, std::memory_order_acq_rel); }
  [[nodiscard]] bool is_activated() const noexcept { return activated_.load(std::memory_order_acquire); }
  /// Whether the last cycle has left out an element that data has come for, as another thread may
  /// still be running it. By the thread of the cycles.
  [[nodiscard]] bool is_held_up() const noexcept { return is_held_up_; }
  /// What the thread of this runner sleeps on, if it waits for data.
  [[nodiscard]] WakeEvent& event() noexcept { return event_; }

 private:
  void Run(std::span<const Schedule::Entry> entries, const Schedule& schedule, CycleMoment now,
           FaultDispatcher& faults) noexcept;
  [[gnu::cold, gnu::noinline]] Time BeginNoting() noexcept;
  [[gnu::cold, gnu::noinline]] void EndNoting(const Schedule& schedule, Time began, CycleMoment now) noexcept;
  [[gnu::noinline]] void RunNoted(const Schedule::Entry& entry, const Schedule& schedule, CycleMoment now,
                                  FaultDispatcher& faults) noexcept;
  [[nodiscard]] bool IsSettled(const Schedule& schedule) noexcept;
  void RunAll(const Schedule& schedule, CycleMoment now, FaultDispatcher& faults) noexcept;
  void RunActivated(const Schedule& schedule, CycleMoment now, FaultDispatcher& faults) noexcept;
  void RunIfActivated(const Schedule::Entry& entry, const Schedule& schedule, bool is_settled, CycleMoment now,
                      FaultDispatcher& faults) noexcept;

  const std::string path_;
  std::atomic<ThreadOptions::Activation> activation_;
  std::atomic<Duration::rep> period_;
  std::atomic<int> priority_;
  std::atomic<ThreadOptions::OnOverrun> on_overrun_;
  std::atomic<std::uint8_t> instruments_{0};
  std::uint8_t noted_ = 0;  // of the cycle that is under way
  RunningTask running_;
  TickClock clock_;  // for what is measured of tasks
  const std::shared_ptr<CycleQuiescence> quiescence_ = std::make_shared<CycleQuiescence>();
  CycleGate gate_;
  std::atomic<const Schedule*> schedule_{nullptr};
  std::uint64_t settled_ = 0;  // the number of the schedule whose elements have all arrived
  std::atomic<std::uint64_t> cycles_begun_{0};
  std::atomic<bool> activated_{false};
  bool is_held_up_ = false;
  WakeEvent event_;
  CycleMeter meter_;
};

}  // namespace runnel

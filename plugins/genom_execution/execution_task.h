#pragma once

#include <atomic>
#include <cstdint>
#include <deque>

#include "core/base/clock.h"
#include "plugins/genom_execution/codel_runner.h"
#include "plugins/genom_execution/request.h"

namespace runnel::genom_execution {

/// What has come of a pass of a task.
enum class Pass : std::uint8_t {
  kIdle,    ///< nothing can be done before the next tick, or before something happens
  kAgain,   ///< some activity has not paused: the next pass belongs to the same period
  kWaiting  ///< in the middle: a codel may not run yet, or is being run by another thread
};

/// An activity of a task. The control task makes it start and stop, the execution task runs it and says when it has
/// ended:
///
///     kFree ──control──▶ kPending ──control──▶ kStarting ──task──▶ kRunning ──task──▶ kEnded ──control──▶ kFree
struct ActivitySlot {
  enum class Phase : std::uint8_t { kFree, kPending, kStarting, kRunning, kEnded };

  explicit ActivitySlot(std::size_t largest_detail) : outcome(largest_detail) {}

  // release by who hands over, acquire by who takes: pairs along the arrows above.
  std::atomic<Phase> phase{Phase::kFree};
  // Who wants it to end; nullptr: nobody. release by the control task, acquire by the task.
  std::atomic<const char*> stopped_by{nullptr};
  Request* request = nullptr;  ///< nullptr: the permanent activity
  const MachineTable* machine = nullptr;
  std::span<const Event> throws = {};
  // The task's.
  std::uint16_t state = kNowhere;
  bool is_paused = false;
  bool is_stopping = false;
  Outcome outcome;  ///< of the permanent activity
};

/// What is told of a task: see Engine::state().
struct TaskFigures {
  std::uint64_t cycles = 0;
  std::uint64_t measured = 0;           ///< of these
  Duration last{}, longest{}, total{};  ///< time in codels, by EngineOptions::clock
};

/// Runs the activities of one task: the permanent one and those that were asked for, one codel of each a pass.
///
/// Threads: Run() by one thread at a time.
class ExecutionTask {
 public:
  ExecutionTask(Engine& engine, std::size_t number);

  /// One pass. Periodic tasks look at the time; `is_forced`: as if it was the time.
  Pass Run(Time now, bool is_forced);
  /// When a periodic task is due; Time::max(): it is not periodic, or has not been run yet.
  [[nodiscard]] Time next_tick() const noexcept { return has_begun_ ? next_tick_ : Time::max(); }
  [[nodiscard]] const TaskTable& table() const noexcept { return table_; }
  [[nodiscard]] bool is_periodic() const noexcept { return table_.period > Duration::zero(); }
  /// Whether the `start` codel of the permanent activity has been run, if there is one.
  [[nodiscard]] bool has_passed() const noexcept { return has_passed_.load(std::memory_order_acquire); }
  [[nodiscard]] TaskFigures figures() const noexcept;

  /// The permanent activity first. The control task looks at all, the task at those below used().
  [[nodiscard]] std::deque<ActivitySlot>& slots() noexcept { return slots_; }
  [[nodiscard]] std::size_t used() const noexcept { return used_.load(std::memory_order_acquire); }
  void set_used(std::size_t used) noexcept { used_.store(used, std::memory_order_release); }

 private:
  [[nodiscard]] bool IsTick(Time now, bool is_forced) noexcept;
  [[nodiscard]] bool Begin(bool is_tick) noexcept;
  [[nodiscard]] bool RunCodels();
  void Follow(ActivitySlot& slot, Event event) noexcept;
  void Stop(ActivitySlot& slot, const char* by) noexcept;
  void Enter(ActivitySlot& slot, std::uint16_t state) noexcept;
  void End(ActivitySlot& slot) noexcept;

  Engine& engine_;
  const TaskTable& table_;
  CodelRunner runner_;
  std::deque<ActivitySlot> slots_;
  std::atomic<std::size_t> used_{1};
  std::atomic<bool> has_passed_{false};
  Time next_tick_{};
  bool has_begun_ = false;
  bool is_first_ = true;
  std::uint64_t seen_ = 0;  // events of the engine
  bool is_suspended_ = false;
  bool goes_on_ = false;  // some activity has not paused
  std::size_t position_ = 0;
  // relaxed: they inform; one writer.
  std::atomic<std::uint64_t> cycles_{0}, measured_{0};
  std::atomic<std::int64_t> last_{0}, longest_{0}, total_{0};
};

}  // namespace runnel::genom_execution

#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/channel/subscribers.h"
#include "plugins/scheduling/fault_dispatcher.h"
#include "plugins/scheduling/task_watch.h"
#include "plugins/timing/task_meter.h"

namespace runnel {

class ChainSteps;
class CycleRunner;
struct TracedElement;

/// The cycle that a thread is in.
struct CycleMoment {
  Time time{};               ///< at its beginning, on the application's clock
  std::uint64_t number = 0;  ///< 1 for the first of the thread
};

/// What the scheduler knows of one element that has tasks: whether it still runs, and whether data
/// has come for it. Outlives changes of the schedule.
///
/// Threads:  Fail(), has_ended() and the note of the pass by the thread whose cycle has it (see
///           schedule.h for how it changes); Wake() by any publisher; set_runner() under the
///           structure lock.
/// Progress: wait-free. Allocation: in the constructor only.
class ScheduledElement final : public Waker {
 public:
  /// `traced`: what is written down of it, if anything is.
  explicit ScheduledElement(std::string path, std::unique_ptr<TracedElement> traced = {});
  ~ScheduledElement();

  [[nodiscard]] const std::string& path() const noexcept { return path_; }

  /// Has cycles leave it out for good, whatever schedule has it. Any thread.
  void End() noexcept { rest_.fetch_or(kEnded, std::memory_order_relaxed); }
  /// Has it left out of cycles, or lets it run again. Any thread.
  void SetPaused(bool is_paused) noexcept {
    is_paused ? rest_.fetch_or(kPaused, std::memory_order_relaxed)
              : rest_.fetch_and(static_cast<std::uint8_t>(~kPaused), std::memory_order_relaxed);
  }
  [[nodiscard]] bool is_paused() const noexcept { return (rest_.load(std::memory_order_relaxed) & kPaused) != 0; }
  /// Whether cycles leave it out.
  [[nodiscard]] bool is_at_rest() const noexcept {
    // relaxed: as has_ended(); one that is paused may run once more.
    return rest_.load(std::memory_order_relaxed) != 0;
  }
  /// Ends it, too, and hands the fault in.
  void Fail(std::string_view message, CycleMoment now, FaultDispatcher& faults) noexcept;
  [[nodiscard]] bool has_ended() const noexcept {
    // relaxed: the hand-over from thread to thread orders a fault, and the epoch that is waited for before
    // an element is destroyed, End(); elsewhere it only informs.
    return (rest_.load(std::memory_order_relaxed) & kEnded) != 0;
  }

  /// How long its runs of this phase take, while that is measured.
  [[nodiscard]] TaskMeter& meter(Phase phase) noexcept { return meters_[static_cast<std::size_t>(phase)]; }
  /// What it has to do with chains whose latency is measured; nullptr: nothing. Owned by this; set under the structure
  /// lock, and what was there before is the caller's to retire.
  [[nodiscard]] const ChainSteps* chains() const noexcept { return chains_.load(std::memory_order_acquire); }
  void set_chains(const ChainSteps* chains) noexcept { chains_.store(chains, std::memory_order_release); }

  /// Calls use(PATH) with the path of an element that may be gone by now, unless it is.
  static void WithPath(const ScheduledElement* element, const std::function<void(const std::string&)>& use);

  /// nullptr: nothing is written down of it. By the thread whose cycle has it.
  [[nodiscard]] TracedElement* traced() noexcept { return traced_.get(); }

  /// What runs `task` while `watch` is there. Under the structure lock.
  [[nodiscard]] BoundCall Watched(const Task& task, TaskWatch& watch);

  /// Who runs the element on new data; nullptr for nobody.
  void set_runner(CycleRunner* runner) noexcept { runner_.store(runner, std::memory_order_seq_cst); }
  [[nodiscard]] CycleRunner* runner() const noexcept { return runner_.load(std::memory_order_seq_cst); }
  /// New data has come: the element shall run in the next triggered pass.
  void Wake() noexcept override;
  /// Whether data has come since the last call.
  [[nodiscard]] bool TakeActivation() noexcept {
    // acq_rel: pairs with the release in Wake(): the data are there.
    return activated_.exchange(false, std::memory_order_acq_rel);
  }
  [[nodiscard]] bool is_activated() const noexcept { return activated_.load(std::memory_order_seq_cst); }
  /// A note of the executor's for the time of one triggered pass: the element's tasks are to run.
  void set_in_pass(bool in_pass) noexcept { in_pass_.store(in_pass, std::memory_order_relaxed); }
  [[nodiscard]] bool in_pass() const noexcept { return in_pass_.load(std::memory_order_relaxed); }

 private:
  const std::string path_;
  const std::unique_ptr<TracedElement> traced_;
  std::vector<std::unique_ptr<WatchedTask>> watched_;  // cycles may be running any of them
  std::unique_ptr<FaultRecord> record_;                // until the element has failed
  static constexpr std::uint8_t kEnded = 1;
  static constexpr std::uint8_t kPaused = 2;
  std::atomic<std::uint8_t> rest_{0};
  std::atomic<bool> activated_{false};
  std::atomic<bool> in_pass_{false};
  std::atomic<CycleRunner*> runner_{nullptr};
  std::atomic<const ChainSteps*> chains_{nullptr};
  std::array<TaskMeter, 3> meters_;  // one for each phase
};

}  // namespace runnel

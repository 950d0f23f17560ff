#pragma once

#include <atomic>
#include <string>

#include "core/channel/waker.h"
#include "core/lockfree/thread_epoch.h"
#include "core/module/module.h"
#include "plugins/genom_execution/component_table.h"

namespace runnel {
class ThreadContainer;
}

namespace runnel::genom_modules {

/// Who is set off when something has happened in a component, if triggers do.
///
/// Threads: SetWaker() under the structure lock, Wake() any.
class WakeTarget {
 public:
  /// Whether something waits is not known: it is set off at once, and finds out.
  void SetWaker(Waker* waker) noexcept {
    // acquire: pairs with the release in Wake(). Of both, which change the same word, one comes second: Wake() finds the
    // waker, or whom this wakes finds what has happened.
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

/// "task 'drive' has a period …", if cycles of that period do not meet its ticks; else "".
[[nodiscard]] std::string MissedTicks(const genom_execution::TaskTable& task, Duration cycle);

}  // namespace runnel::genom_modules

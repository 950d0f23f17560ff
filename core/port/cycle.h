#pragma once

#include "core/base/clock.h"
#include "core/lockfree/thread_epoch.h"

namespace runnel {

/// The cycle that the calling thread is in: what an executor sets once for all modules of a cycle,
/// so that publishing needs no clock and all values of a cycle bear the same time.
struct Cycle {
  Time now{};         ///< when the cycle began, on the application's clock
  Duration period{};  ///< planned time from cycle to cycle; 0 if there is no plan
  /// The oldest measurement that the module has read in this cycle (Ageing::kTimesOut); what it publishes is no
  /// newer than that.
  Time stamp = Time::max();
};

/// nullptr outside of a cycle. Threads: each has its own.
[[nodiscard]] const Cycle* CurrentCycle() noexcept;

/// Makes `cycle` the calling thread's current one for the scope's life. May be nested.
class CycleScope {
 public:
  explicit inline CycleScope(const Cycle& cycle) noexcept;
  inline ~CycleScope();
  CycleScope(const CycleScope&) = delete;
  CycleScope& operator=(const CycleScope&) = delete;

 private:
  Cycle cycle_;
  Cycle* outer_;
};

namespace internal {
extern thread_local constinit Cycle* current_cycle __attribute__((tls_model("initial-exec")));
}  // namespace internal

inline CycleScope::CycleScope(const Cycle& cycle) noexcept : cycle_(cycle), outer_(internal::current_cycle) {
  internal::current_cycle = &cycle_;
}
inline CycleScope::~CycleScope() { internal::current_cycle = outer_; }

inline const Cycle* CurrentCycle() noexcept { return internal::current_cycle; }

namespace internal {
/// What the module publishes in this cycle from now on is of `measured`, or older.
inline void AgeCycle(Time measured) noexcept {
  if (current_cycle != nullptr && measured < current_cycle->stamp) current_cycle->stamp = measured;
}
/// For executors: what the next module publishes has an age of its own.
inline void BeginModule() noexcept {
  if (current_cycle != nullptr) current_cycle->stamp = Time::max();
}
}  // namespace internal

/// A cycle of a thread of the user's own (a driver's, a GUI's), as executors open one for modules: as long as it
/// lives, reading and publishing cost that thread as little as a module, and what is published bears its time.
///
///     while (driver.WaitForFrame()) {                     // asleep: outside
///       const OwnCycle cycle(runtime.clock().Now());
///       out.Publish(driver.frame(), driver.timestamp());
///     }
///
/// As long as one lives nothing that is taken out of the structure is deleted: do not sleep or wait in it.
///
/// Threads:     an object of the stack; lives and dies in one thread. May be nested.
/// Allocation:  the first one of a thread registers the thread, which allocates.
class OwnCycle {
 public:
  /// `now`: on the application's clock; `period`: planned time from cycle to cycle, 0 if there is no plan.
  explicit OwnCycle(Time now, Duration period = {}) : cycle_({.now = now, .period = period}) {}

 private:
  const EpochGuard guard_;
  const CycleScope cycle_;
};

}  // namespace runnel

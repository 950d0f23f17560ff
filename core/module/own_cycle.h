#pragma once

#include "core/base/clock.h"
#include "core/lockfree/thread_epoch.h"
#include "core/port/cycle.h"

namespace runnel {

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

#pragma once

#include "core/base/clock.h"

namespace runnel {

/// How a thread container runs its modules.
struct ThreadOptions {
  enum class Activation {
    kPeriod,       ///< once every `period`
    kFreeRunning,  ///< again as soon as it has ended
    kTrigger,      ///< a module runs when data has come to one of its trigger inputs, else not
  };
  /// What happens to the cycles that a cycle that took too long has used up.
  enum class OnOverrun {
    kSkip,     ///< left out: the next cycle begins at the next planned time
    kCatchUp,  ///< run one after the other, without a pause, until the plan is met again
  };

  Activation activation = Activation::kPeriod;
  /// kPeriod: from cycle to cycle. kFreeRunning: how long a cycle takes in simulated time, since
  /// there no time would pass otherwise; without meaning on the real clock.
  Duration period = std::chrono::milliseconds(10);
  int priority = 0;  ///< 0: ordinary scheduling; 1 .. 99: SCHED_FIFO with this priority
  OnOverrun on_overrun = OnOverrun::kSkip;
};

}  // namespace runnel

#pragma once

#include <cstdint>

#include "core/base/clock.h"
#include "core/lockfree/latest_value.h"

namespace runnel {

/// How the cycles of one thread have gone so far. All but the execution times are measured on the
/// application's clock, so in simulated time they say what was simulated.
struct CycleStatistics {
  std::uint64_t cycles = 0;
  std::uint64_t overruns = 0;  ///< cycles that ended after the next one was due
  Duration period_mean{};      ///< from start to start; 0 before the second cycle, as are min, max
  Duration period_min{};
  Duration period_max{};
  Duration jitter_mean{};  ///< |start - due time|; 0 for threads without a plan
  Duration jitter_max{};
  /// What the modules take, on the machine's clock; of free-running threads from start to start.
  Duration execution_mean{};
  Duration execution_max{};
  /// Of the last whole second, and of ten cycles at least.
  std::uint64_t recent_cycles = 0;
  std::uint64_t recent_overruns = 0;
  bool is_late = false;  ///< most of these; once that was so, until hardly any is
};

/// What is measured of one cycle.
struct CycleMeasurement {
  Time due{};    ///< equals `start` for threads without a plan
  Time start{};  ///< on the application's clock
  Duration execution{};
  bool overrun = false;
};

/// Sums up measurements, and lets others look at the sum meanwhile. What a cycle pays for is adding up;
/// who looks does the dividing.
///
/// Threads:   Add() by one thread at a time; statistics() by any. Progress: as LatestValue.
/// Allocation: none.
class CycleMeter {
 public:
  void Add(const CycleMeasurement& cycle) noexcept;
  [[nodiscard]] CycleStatistics statistics() const noexcept;

 private:
  // Until they have been divided, what is called mean is a sum.
  struct Sums {
    CycleStatistics of;
    Time first_start{};
    Time last_start{};
    // With which the second that is under way began.
    Time second_start{};
    std::uint64_t cycles_before = 0;
    std::uint64_t overruns_before = 0;
  };
  void EndSecond(Time now) noexcept;

  Sums sums_;  // the writer's own
  LatestValue<Sums> shown_;
};

}  // namespace runnel

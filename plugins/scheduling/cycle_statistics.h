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
  Duration execution_mean{};  ///< what the modules take, on the machine's clock
  Duration execution_max{};
};

/// What is measured of one cycle.
struct CycleMeasurement {
  Time due{};    ///< equals `start` for threads without a plan
  Time start{};  ///< on the application's clock
  Duration execution{};
  bool overrun = false;
};

/// Sums up measurements, and lets others look at the sum meanwhile.
///
/// Threads:   Add() by one thread at a time; statistics() by any. Progress: wait-free / lock-free.
/// Allocation: none.
class CycleMeter {
 public:
  void Add(const CycleMeasurement& cycle) noexcept;
  [[nodiscard]] CycleStatistics statistics() const noexcept;

 private:
  CycleStatistics sum_;  // the writer's own, as is what follows
  Time first_start_{};
  Time last_start_{};
  Duration jitter_sum_{};
  Duration execution_sum_{};
  LatestValue<CycleStatistics> published_;
};

}  // namespace runnel

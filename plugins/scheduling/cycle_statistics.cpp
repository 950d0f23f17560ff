#include "plugins/scheduling/cycle_statistics.h"

#include <algorithm>
#include <chrono>

namespace runnel {

void CycleMeter::Add(const CycleMeasurement& cycle) noexcept {
  if (sum_.cycles == 0) {
    first_start_ = cycle.start;
  } else {
    const Duration period = cycle.start - last_start_;
    sum_.period_min = sum_.cycles == 1 ? period : std::min(sum_.period_min, period);
    sum_.period_max = std::max(sum_.period_max, period);
    sum_.period_mean = (cycle.start - first_start_) / static_cast<std::int64_t>(sum_.cycles);
  }
  last_start_ = cycle.start;
  ++sum_.cycles;
  if (cycle.overrun) ++sum_.overruns;
  const auto cycles = static_cast<std::int64_t>(sum_.cycles);
  const Duration jitter = std::chrono::abs(cycle.start - cycle.due);
  jitter_sum_ += jitter;
  sum_.jitter_mean = jitter_sum_ / cycles;
  sum_.jitter_max = std::max(sum_.jitter_max, jitter);
  execution_sum_ += cycle.execution;
  sum_.execution_mean = execution_sum_ / cycles;
  sum_.execution_max = std::max(sum_.execution_max, cycle.execution);
  published_.Publish(sum_, cycle.start.time_since_epoch().count());
}

CycleStatistics CycleMeter::statistics() const noexcept {
  CycleStatistics statistics;
  Publication publication;
  published_.Read(statistics, publication);
  return statistics;
}

}  // namespace runnel

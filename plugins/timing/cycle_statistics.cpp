#include "plugins/timing/cycle_statistics.h"

#include <algorithm>
#include <chrono>

namespace runnel {

void CycleMeter::Add(const CycleMeasurement& cycle) noexcept {
  CycleStatistics& sums = sums_.of;
  ++sums.cycles;
  if (sums.cycles == 1) {
    sums_.first_start = cycle.start;
  } else {
    const Duration period = cycle.start - sums_.last_start;
    sums.period_min = sums.cycles == 2 ? period : std::min(sums.period_min, period);
    sums.period_max = sums.cycles == 2 ? period : std::max(sums.period_max, period);
  }
  sums_.last_start = cycle.start;
  if (cycle.overrun) ++sums.overruns;
  const Duration jitter = std::chrono::abs(cycle.start - cycle.due);
  sums.jitter_mean += jitter;
  sums.jitter_max = std::max(sums.jitter_max, jitter);
  sums.execution_mean += cycle.execution;
  sums.execution_max = std::max(sums.execution_max, cycle.execution);
  shown_.Publish(sums_, 0);
}

CycleStatistics CycleMeter::statistics() const noexcept {
  Sums sums;
  if (!shown_.Read(sums)) return {};
  CycleStatistics statistics = sums.of;
  const auto cycles = static_cast<std::int64_t>(statistics.cycles);
  statistics.period_mean =
      (sums.last_start - sums.first_start) / std::max<std::int64_t>(cycles - 1, 1);
  statistics.jitter_mean /= cycles;
  statistics.execution_mean /= cycles;
  return statistics;
}

}  // namespace runnel

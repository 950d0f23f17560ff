#include "plugins/timing/cycle_statistics.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace runnel {

namespace {

constexpr Duration kSecond = std::chrono::seconds(1);
constexpr std::uint64_t kFewest = 10;

}  // namespace

void CycleMeter::Add(const CycleMeasurement& cycle) noexcept {
  CycleStatistics& sums = sums_.of;
  ++sums.cycles;
  if (sums.cycles == 1) {
    sums_.first_start = cycle.start;
    sums_.second_start = cycle.start;
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
  if (cycle.start - sums_.second_start >= kSecond && sums.cycles - sums_.cycles_before >= kFewest) [[unlikely]] {
    EndSecond(cycle.start);
  }
  shown_.Publish(sums_, 0);
}

void CycleMeter::EndSecond(Time now) noexcept {
  CycleStatistics& sums = sums_.of;
  sums.recent_cycles = sums.cycles - std::exchange(sums_.cycles_before, sums.cycles);
  sums.recent_overruns = sums.overruns - std::exchange(sums_.overruns_before, sums.overruns);
  sums.is_late = sums.recent_overruns * (sums.is_late ? 10 : 2) > sums.recent_cycles;
  sums_.second_start = now;
}

CycleStatistics CycleMeter::statistics() const noexcept {
  Sums sums;
  if (!shown_.Read(sums)) return {};
  CycleStatistics statistics = sums.of;
  const auto cycles = static_cast<std::int64_t>(statistics.cycles);
  statistics.period_mean = (sums.last_start - sums.first_start) / std::max<std::int64_t>(cycles - 1, 1);
  statistics.jitter_mean /= cycles;
  statistics.execution_mean /= cycles;
  return statistics;
}

}  // namespace runnel

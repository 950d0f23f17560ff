#include "plugins/scheduling/cycle_statistics.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace runnel {

void CycleMeter::Add(const CycleMeasurement& cycle) noexcept {
  const std::int64_t start = cycle.start.time_since_epoch().count();
  const std::int64_t period = start - sums_[kLastStart];
  if (sums_[kCycles] == 0) {
    sums_[kFirstStart] = start;
  } else if (sums_[kCycles] == 1) {
    sums_[kPeriodMin] = sums_[kPeriodMax] = period;
  } else {
    sums_[kPeriodMin] = std::min(sums_[kPeriodMin], period);
    sums_[kPeriodMax] = std::max(sums_[kPeriodMax], period);
  }
  sums_[kLastStart] = start;
  ++sums_[kCycles];
  sums_[kOverruns] += cycle.overrun ? 1 : 0;
  const std::int64_t jitter = std::abs((cycle.start - cycle.due).count());
  sums_[kJitter] += jitter;
  sums_[kJitterMax] = std::max(sums_[kJitterMax], jitter);
  const std::int64_t execution = cycle.execution.count();
  sums_[kExecution] += execution;
  sums_[kExecutionMax] = std::max(sums_[kExecutionMax], execution);
  Publish();
}

void CycleMeter::Publish() noexcept {
  const std::int64_t number = sums_[kCycles];
  Cell& cell = cells_[number % 2];
  // relaxed: the release stores of the words carry it to whoever sees one of them.
  cell.number.store(kBeingWritten, std::memory_order_relaxed);
  // release: pairs with the acquire loads of the words in Read(): who sees one of these words also
  // sees kBeingWritten, or something later, in the check that ends its copy.
  for (std::size_t i = 0; i < kWords; ++i) {
    cell.words[i].store(sums_[i], std::memory_order_release);
  }
  // relaxed: the release store below carries it.
  cell.number.store(number, std::memory_order_relaxed);
  // release: pairs with the acquire in Read(): the whole cell is visible with its number.
  published_.store(number, std::memory_order_release);
}

CycleMeter::Sums CycleMeter::Read() const noexcept {
  Sums sums{};
  for (;;) {
    // acquire: pairs with the last store in Publish().
    const std::int64_t number = published_.load(std::memory_order_acquire);
    if (number == 0) return sums;
    const Cell& cell = cells_[number % 2];
    // acquire: keeps the check below from moving up; see Publish().
    for (std::size_t i = 0; i < kWords; ++i) {
      sums[i] = cell.words[i].load(std::memory_order_acquire);
    }
    // relaxed: the acquire loads above order it.
    if (cell.number.load(std::memory_order_relaxed) == number) return sums;
  }
}

CycleStatistics CycleMeter::statistics() const noexcept {
  const Sums sums = Read();
  const std::int64_t cycles = sums[kCycles];
  if (cycles == 0) return {};
  const std::int64_t periods = std::max<std::int64_t>(cycles - 1, 1);
  return {.cycles = static_cast<std::uint64_t>(cycles),
          .overruns = static_cast<std::uint64_t>(sums[kOverruns]),
          .period_mean = Duration((sums[kLastStart] - sums[kFirstStart]) / periods),
          .period_min = Duration(sums[kPeriodMin]),
          .period_max = Duration(sums[kPeriodMax]),
          .jitter_mean = Duration(sums[kJitter] / cycles),
          .jitter_max = Duration(sums[kJitterMax]),
          .execution_mean = Duration(sums[kExecution] / cycles),
          .execution_max = Duration(sums[kExecutionMax])};
}

}  // namespace runnel

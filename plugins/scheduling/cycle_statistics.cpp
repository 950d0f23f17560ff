#include "plugins/scheduling/cycle_statistics.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace runnel {

void CycleMeter::Add(const CycleMeasurement& cycle) noexcept {
  // relaxed, here and for the words of the cell before: the writer's own.
  const std::int64_t number = published_.load(std::memory_order_relaxed) + 1;
  const Cell& before = cells_[(number - 1) % 2];
  Cell& next = cells_[number % 2];
  const auto sum = [&](Word word) { return before.words[word].load(std::memory_order_relaxed); };
  // relaxed: the release stores of the words carry it to whoever sees one of them.
  next.number.store(kBeingWritten, std::memory_order_relaxed);
  // release: pairs with the acquire loads of the words in Read(): who sees one of these words also
  // sees kBeingWritten, or something later, in the check that ends its copy.
  const auto set = [&](Word word, std::int64_t value) {
    next.words[word].store(value, std::memory_order_release);
  };
  const std::int64_t start = cycle.start.time_since_epoch().count();
  const std::int64_t period = start - sum(kLastStart);
  set(kFirstStart, number > 1 ? sum(kFirstStart) : start);
  set(kPeriodMin, number > 2 ? std::min(sum(kPeriodMin), period) : number == 2 ? period : 0);
  set(kPeriodMax, number > 2 ? std::max(sum(kPeriodMax), period) : number == 2 ? period : 0);
  set(kLastStart, start);
  set(kOverruns, sum(kOverruns) + (cycle.overrun ? 1 : 0));
  const std::int64_t jitter = std::abs((cycle.start - cycle.due).count());
  set(kJitter, sum(kJitter) + jitter);
  set(kJitterMax, std::max(sum(kJitterMax), jitter));
  const std::int64_t execution = cycle.execution.count();
  set(kExecution, sum(kExecution) + execution);
  set(kExecutionMax, std::max(sum(kExecutionMax), execution));
  // relaxed: the release store below carries it.
  next.number.store(number, std::memory_order_relaxed);
  // release: pairs with the acquire in Read(): the whole cell is visible with its number.
  published_.store(number, std::memory_order_release);
}

std::int64_t CycleMeter::Read(Sums& sums) const noexcept {
  for (;;) {
    // acquire: pairs with the last store in Add().
    const std::int64_t number = published_.load(std::memory_order_acquire);
    if (number == 0) return 0;
    const Cell& cell = cells_[number % 2];
    // acquire: keeps the check below from moving up; see Add().
    for (std::size_t i = 0; i < kWords; ++i) {
      sums[i] = cell.words[i].load(std::memory_order_acquire);
    }
    // relaxed: the acquire loads above order it.
    if (cell.number.load(std::memory_order_relaxed) == number) return number;
  }
}

CycleStatistics CycleMeter::statistics() const noexcept {
  Sums sums{};
  const std::int64_t cycles = Read(sums);
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

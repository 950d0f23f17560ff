#include "plugins/scheduling/cycle_statistics.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>

namespace runnel {

void CycleMeter::Add(const CycleMeasurement& cycle) noexcept {
  if (sums_.cycles == 0) {
    sums_.first_start = cycle.start;
  } else {
    const Duration period = cycle.start - sums_.last_start;
    sums_.period_min = std::min(sums_.period_min, period);
    sums_.period_max = std::max(sums_.period_max, period);
  }
  sums_.last_start = cycle.start;
  ++sums_.cycles;
  if (cycle.overrun) ++sums_.overruns;
  const Duration jitter = std::chrono::abs(cycle.start - cycle.due);
  sums_.jitter += jitter;
  sums_.jitter_max = std::max(sums_.jitter_max, jitter);
  sums_.execution += cycle.execution;
  sums_.execution_max = std::max(sums_.execution_max, cycle.execution);
  Publish();
}

void CycleMeter::Publish() noexcept {
  Cell& cell = cells_[sums_.cycles % cells_.size()];
  // relaxed: the release stores of the words carry it to whoever sees one of them.
  cell.cycles.store(kBeingWritten, std::memory_order_relaxed);
  std::array<std::uint64_t, kWords> words;
  std::memcpy(words.data(), &sums_, sizeof(sums_));
  // release: pairs with the acquire loads of the words in Read(): who sees one of these words also
  // sees kBeingWritten, or something later, in the check that ends its copy.
  for (std::size_t i = 0; i < kWords; ++i) {
    cell.words[i].store(words[i], std::memory_order_release);
  }
  // relaxed: the release store below carries it.
  cell.cycles.store(sums_.cycles, std::memory_order_relaxed);
  // release: pairs with the acquire in Read(): the whole cell is visible with its number.
  published_.store(sums_.cycles, std::memory_order_release);
}

CycleMeter::Sums CycleMeter::Read() const noexcept {
  for (;;) {
    // acquire: pairs with the last store in Publish().
    const std::uint64_t cycles = published_.load(std::memory_order_acquire);
    if (cycles == 0) return {};
    const Cell& cell = cells_[cycles % cells_.size()];
    std::array<std::uint64_t, kWords> words;
    // acquire: keeps the check below from moving up; see Publish().
    for (std::size_t i = 0; i < kWords; ++i) {
      words[i] = cell.words[i].load(std::memory_order_acquire);
    }
    // relaxed: the acquire loads above order it.
    if (cell.cycles.load(std::memory_order_relaxed) != cycles) continue;
    Sums sums;
    std::memcpy(static_cast<void*>(&sums), words.data(), sizeof(sums));
    return sums;
  }
}

CycleStatistics CycleMeter::statistics() const noexcept {
  const Sums sums = Read();
  CycleStatistics statistics;
  if (sums.cycles == 0) return statistics;
  const auto cycles = static_cast<std::int64_t>(sums.cycles);
  statistics.cycles = sums.cycles;
  statistics.overruns = sums.overruns;
  if (cycles > 1) {
    statistics.period_mean = (sums.last_start - sums.first_start) / (cycles - 1);
    statistics.period_min = sums.period_min;
    statistics.period_max = sums.period_max;
  }
  statistics.jitter_mean = sums.jitter / cycles;
  statistics.jitter_max = sums.jitter_max;
  statistics.execution_mean = sums.execution / cycles;
  statistics.execution_max = sums.execution_max;
  return statistics;
}

}  // namespace runnel

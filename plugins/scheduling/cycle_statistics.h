#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "core/base/clock.h"
#include "core/lockfree/cache_line.h"

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
/// What a cycle pays for is adding up; who looks does the dividing. Two cells are written in turn, each
/// from what the other one has, so that a reader never waits for a writer that has been interrupted.
///
/// Threads:   Add() by one thread at a time; statistics() by any. Progress: wait-free / lock-free
///            (repeated only if a whole cycle has gone by meanwhile).
/// Allocation: none.
class CycleMeter {
 public:
  void Add(const CycleMeasurement& cycle) noexcept;
  [[nodiscard]] CycleStatistics statistics() const noexcept;

 private:
  // All are sums and extremes of counts, or of nanoseconds, in words that are copied one by one.
  enum Word {
    kOverruns,
    kFirstStart,
    kLastStart,
    kPeriodMin,
    kPeriodMax,
    kJitter,
    kJitterMax,
    kExecution,
    kExecutionMax,
    kWords
  };
  using Sums = std::array<std::int64_t, kWords>;
  static constexpr std::int64_t kBeingWritten = 0;

  struct alignas(kCacheLineSize) Cell {
    std::atomic<std::int64_t> number{kBeingWritten};  // of the cycle that it was written after
    std::array<std::atomic<std::int64_t>, kWords> words{};
  };

  // Returns the number of cycles in them; 0: none yet.
  std::int64_t Read(Sums& sums) const noexcept;

  std::array<Cell, 2> cells_;
  alignas(kCacheLineSize) std::atomic<std::int64_t> published_{0};  // the number of cycles
};

}  // namespace runnel

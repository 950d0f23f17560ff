#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>

#include "core/base/clock.h"

namespace runnel {

/// How long the runs of one task have taken, on the machine's clock.
struct TaskTimes {
  std::uint64_t runs = 0;
  Duration last{};
  Duration max{};
  Duration total{};
  [[nodiscard]] Duration mean() const noexcept {
    return runs == 0 ? Duration{} : total / static_cast<std::int64_t>(runs);
  }
};

/// Adds them up while others look.
///
/// Threads:   Add() by the thread whose cycle has the task; times() by any, each figure by itself. Progress: wait-free.
class TaskMeter {
 public:
  void Add(Duration duration) noexcept {
    // relaxed: figures for people; one thread writes.
    last_.store(duration.count(), std::memory_order_relaxed);
    max_.store(std::max(max_.load(std::memory_order_relaxed), duration.count()), std::memory_order_relaxed);
    total_.store(total_.load(std::memory_order_relaxed) + duration.count(), std::memory_order_relaxed);
    runs_.store(runs_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }
  /// While nobody adds; what is just being added may count yet.
  void Reset() noexcept {
    for (auto* each : {&last_, &max_, &total_}) each->store(0, std::memory_order_relaxed);
    runs_.store(0, std::memory_order_relaxed);
  }
  [[nodiscard]] TaskTimes times() const noexcept {
    return {runs_.load(std::memory_order_relaxed), Duration(last_.load(std::memory_order_relaxed)),
            Duration(max_.load(std::memory_order_relaxed)), Duration(total_.load(std::memory_order_relaxed))};
  }

 private:
  std::atomic<std::uint64_t> runs_{0};
  std::atomic<std::int64_t> last_{0};
  std::atomic<std::int64_t> max_{0};
  std::atomic<std::int64_t> total_{0};
};

}  // namespace runnel

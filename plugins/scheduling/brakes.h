#pragma once

#include <algorithm>
#include <atomic>
#include <mutex>
#include <vector>

#include "core/base/ordered_mutex.h"

namespace runnel {

/// Keeps simulated time from going on where something beside the application must not fall behind, such
/// as a recorder. What cycles compute does not depend on it.
class Brake {
 public:
  /// Is called after each simulated cycle, by the thread that runs them, without locks; returns when the
  /// next may begin.
  virtual void HoldBack() noexcept = 0;

 protected:
  ~Brake() = default;
};

/// Those of one scheduler. Threads: any; HoldBack() by the one that steps. While there are none, that
/// takes no lock.
class Brakes {
 public:
  void Add(Brake& brake) {
    const std::lock_guard lock(mutex_);
    all_.push_back(&brake);
    any_.store(true, std::memory_order_release);
  }
  /// Waits for a HoldBack() that is under way.
  void Remove(Brake& brake) {
    const std::lock_guard lock(mutex_);
    std::erase(all_, &brake);
    any_.store(!all_.empty(), std::memory_order_release);
  }
  void HoldBack() {
    if (!any_.load(std::memory_order_acquire)) return;
    const std::lock_guard lock(mutex_);
    for (Brake* brake : all_) brake->HoldBack();
  }

 private:
  OrderedMutex mutex_{LockLevel::kScheduler};
  std::atomic<bool> any_{false};
  std::vector<Brake*> all_;
};

}  // namespace runnel

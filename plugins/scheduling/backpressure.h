#pragma once

#include <atomic>
#include <mutex>
#include <vector>

#include "core/base/ordered_mutex.h"

namespace runnel {

/// Keeps simulated time from going on where something beside the application must not fall behind, such
/// as a recorder. What cycles compute does not depend on it.
class BackpressureSource {
 public:
  /// Is called after each simulated cycle, by the thread that runs them, without locks; returns when the
  /// next may begin.
  virtual void WaitForRoom() noexcept = 0;

 protected:
  ~BackpressureSource() = default;
};

/// Those of one scheduler. Threads: any; WaitForRoom() by the one that steps. While there are none, that
/// takes no lock.
class Backpressure {
 public:
  void Add(BackpressureSource& source) {
    const std::lock_guard lock(mutex_);
    all_.push_back(&source);
    any_.store(true, std::memory_order_release);
  }
  /// Waits for a WaitForRoom() that is under way.
  void Remove(BackpressureSource& source) {
    const std::lock_guard lock(mutex_);
    std::erase(all_, &source);
    any_.store(!all_.empty(), std::memory_order_release);
  }
  void WaitForRoom() {
    if (!any_.load(std::memory_order_acquire)) return;
    const std::lock_guard lock(mutex_);
    for (BackpressureSource* source : all_) source->WaitForRoom();
  }

 private:
  OrderedMutex mutex_{LockLevel::kScheduler};
  std::atomic<bool> any_{false};
  std::vector<BackpressureSource*> all_;
};

}  // namespace runnel

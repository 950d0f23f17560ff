#pragma once

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <ctime>

#include <semaphore.h>

#include "core/base/clock.h"

namespace runnel {

/// Lets one thread sleep until another has something for it. Notifications that come before the
/// thread looks add up to one.
///
/// Threads:  Notify() from any thread: it never blocks, and calls the system only if the other
///           thread sleeps. Wait() by one thread at a time.
class WakeEvent {
 public:
  WakeEvent() noexcept { sem_init(&semaphore_, 0, 0); }
  ~WakeEvent() { sem_destroy(&semaphore_); }
  WakeEvent(const WakeEvent&) = delete;
  WakeEvent& operator=(const WakeEvent&) = delete;

  void Notify() noexcept {
    // acq_rel: what the notifier did before is visible to the waiter that clears the flag, even if
    // an earlier notification has set it.
    if (!notified_.exchange(true, std::memory_order_acq_rel)) sem_post(&semaphore_);
  }

  void Wait() noexcept {
    while (sem_wait(&semaphore_) != 0) {  // a signal has interrupted it
    }
    notified_.exchange(false, std::memory_order_acq_rel);
  }

  /// Until `deadline` by the steady clock, if nothing comes before.
  void WaitUntil(Time deadline) noexcept {
    const auto since = std::max(deadline.time_since_epoch(), Duration::zero());
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(since);
    timespec until{};
    until.tv_sec = static_cast<time_t>(seconds.count());
    until.tv_nsec = static_cast<long>((since - seconds).count());
    while (sem_clockwait(&semaphore_, CLOCK_MONOTONIC, &until) != 0) {
      if (errno == ETIMEDOUT) return;
    }
    notified_.exchange(false, std::memory_order_acq_rel);
  }

 private:
  sem_t semaphore_;
  std::atomic<bool> notified_{false};
};

}  // namespace runnel

#pragma once

#include <atomic>

#include <semaphore.h>

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

 private:
  sem_t semaphore_;
  std::atomic<bool> notified_{false};
};

}  // namespace runnel

#pragma once

#include <atomic>

#include "core/lockfree/thread_epoch.h"
#include "core/channel/waker.h"

namespace runnel::genom_modules {

/// Who is set off when something has happened in a component, if triggers do.
///
/// Threads: SetWaker() under the structure lock, Wake() any.
class WakeTarget {
 public:
  /// Whether something waits is not known: it is set off at once, and finds out.
  void SetWaker(Waker* waker) noexcept {
    // acquire: pairs with the release in Wake(). Of both, which change the same word, one comes second: Wake() finds the
    // waker, or whom this wakes finds what has happened.
    (void)waker_.exchange(waker, std::memory_order_acq_rel);
    if (waker != nullptr) waker->Wake();
  }
  void Wake() noexcept {
    const EpochGuard guard;  // it is there until nobody is inside one that began before it was taken back
    Waker* waker = nullptr;
    // A change, though of nothing. release: pairs with the acquire in SetWaker().
    if (!waker_.compare_exchange_strong(waker, nullptr, std::memory_order_acq_rel)) waker->Wake();
  }

 private:
  std::atomic<Waker*> waker_{nullptr};
};

}  // namespace runnel::genom_modules

#include "core/log/internal/log_ring.h"

#include <memory>
#include <new>

#include "core/log/logger.h"

namespace runnel::internal {

std::atomic<LogRing*> LogRing::first_{nullptr};
thread_local constinit LogRing* log_ring = nullptr;

void TakeLogRing() noexcept {
  struct Ending {
    ~Ending() { std::exchange(log_ring, nullptr)->GiveBack(); }
  };
  try {
    log_ring = &LogRing::Take();
  } catch (const std::bad_alloc&) {
    return;
  }
  static thread_local const Ending ending;
}

LogRing& LogRing::Take() {
  LogRing* free = nullptr;
  ForEach([&](LogRing& ring) {
    bool taken = false;
    // acquire: as in GiveBack(); relaxed: another thread has it.
    if (free == nullptr &&
        ring.taken_.compare_exchange_strong(taken, true, std::memory_order_acquire, std::memory_order_relaxed)) {
      free = &ring;
    }
  });
  if (free != nullptr) return *free;
  LogRing* const added = std::make_unique<LogRing>().release();
  added->next_ = first_.load(std::memory_order_relaxed);
  // release: pairs with the acquire in ForEach().
  while (!first_.compare_exchange_weak(added->next_, added, std::memory_order_release, std::memory_order_relaxed)) {
  }
  return *added;
}

}  // namespace runnel::internal

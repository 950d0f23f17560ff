#include "plugins/network/offer_bell.h"

#include <thread>

#include "core/lockfree/wake_event.h"

namespace runnel {

void OfferBell::Wake() noexcept {
  if (is_sent_after_cycles_.load(std::memory_order_relaxed) && DoAfterCycle()) return;
  Ring();
}

void OfferBell::Ring() noexcept {
  // release: who answers sees what has been published before.
  has_rung_.store(true, std::memory_order_release);
  wake_->Notify();
}

// Each sends once: who would go on for as long as others ask could be kept by them for ever.
void OfferBell::TakeTurn(By by) noexcept {
  bool has_sent = false;
  turns_.Do([&]() noexcept {
    if (is_closed_) return;
    if (std::exchange(has_sent, true)) return Ring();
    send_(by);
  });
}

void OfferBell::Close() noexcept {
  for (bool is_done = false; !is_done; std::this_thread::yield()) {
    turns_.Do([&]() noexcept { is_done = is_closed_ = true; });
  }
}

}  // namespace runnel

#include "plugins/network/offer_bell.h"

#include "core/lockfree/wake_event.h"

namespace runnel {

void OfferBell::Wake() noexcept {
  if (is_sent_after_cycles_.load(std::memory_order_relaxed) && DoAfterCycle()) return;
  Ring();
}

void OfferBell::Ring() noexcept {
  turns_.Ring();
  wake_->Notify();
}

void OfferBell::TakeTurn(By by) noexcept {
  turns_.Send([&] { send_(by); }, [&] { Ring(); });
}

}  // namespace runnel

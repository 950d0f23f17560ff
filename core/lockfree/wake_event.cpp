#include "core/lockfree/wake_event.h"

#include <algorithm>
#include <atomic>
#include <bit>

namespace runnel {

namespace {

using Seats = Bell<>::Seats;

// Bells are only ever added: who rings for a sleeper may still do so when that has gone.
struct SharedBell : Bell<> {
  std::atomic<Seats> taken{0};
  SharedBell* next = nullptr;  // constant once added
};
constinit std::atomic<SharedBell*> all_bells{nullptr};

// A seat of its own, or 0 if all are taken.
Seats TakeSeat(SharedBell& bell) noexcept {
  // relaxed, all: a seat hands nothing over. A ring that was meant for who sat there before wakes for
  // nothing, which sleepers know.
  Seats taken = bell.taken.load(std::memory_order_relaxed);
  while (~taken != 0) {
    const Seats seat = Seats{1} << std::countr_one(taken);
    if (bell.taken.compare_exchange_weak(taken, taken | seat, std::memory_order_relaxed,
                                         std::memory_order_relaxed)) {
      return seat;
    }
  }
  return 0;
}

Sleeper<> TakeAnySeat() {
  // acquire: pairs with the release below; the bell is complete.
  for (SharedBell* bell = all_bells.load(std::memory_order_acquire); bell != nullptr;
       bell = bell->next) {
    if (const Seats seat = TakeSeat(*bell); seat != 0) return {*bell, seat};
  }
  auto* const bell = new SharedBell;
  const Seats seat = TakeSeat(*bell);
  bell->next = all_bells.load(std::memory_order_relaxed);
  while (!all_bells.compare_exchange_weak(bell->next, bell, std::memory_order_release,
                                          std::memory_order_relaxed)) {
  }
  return {*bell, seat};
}

}  // namespace

WakeEvent::WakeEvent() : sleeper_(TakeAnySeat()) {}

WakeEvent::~WakeEvent() {
  static_cast<SharedBell&>(sleeper_.bell())
      .taken.fetch_and(~sleeper_.seat(), std::memory_order_relaxed);
}

void WakeEvent::WaitUntil(Time deadline) noexcept {
  // The steady clock is that of the deadlines, and both count from the machine's start.
  const auto since = std::max(deadline.time_since_epoch(), Duration::zero());
  (void)sleeper_.Wait(KernelFutex::Deadline(since));
}

}  // namespace runnel

#include "core/lockfree/wake_event.h"

#include <algorithm>
#include <atomic>
#include <bit>

namespace runnel {

namespace {

using Waiters = EventCount<>::Waiters;

// Event counts are only ever added: who notifies a waiter may still do so when that has gone.
struct SharedEventCount : EventCount<> {
  std::atomic<Waiters> taken{0};
  SharedEventCount* next = nullptr;  // constant once added
};
constinit std::atomic<SharedEventCount*> all_event_counts{nullptr};

// A bit of its own, or 0 if all are taken.
Waiters TakeWaiterBit(SharedEventCount& event_count) noexcept {
  // relaxed, all: a bit hands nothing over. A notification that was meant for who had it before wakes for
  // nothing, which waiters know.
  Waiters taken = event_count.taken.load(std::memory_order_relaxed);
  while (~taken != 0) {
    const Waiters waiter_bit = Waiters{1} << std::countr_one(taken);
    if (event_count.taken.compare_exchange_weak(taken, taken | waiter_bit, std::memory_order_relaxed,
                                                std::memory_order_relaxed)) {
      return waiter_bit;
    }
  }
  return 0;
}

Waiter<> MakeWaiter() {
  // acquire: pairs with the release below; the event count is complete.
  for (SharedEventCount* event_count = all_event_counts.load(std::memory_order_acquire); event_count != nullptr;
       event_count = event_count->next) {
    if (const Waiters waiter_bit = TakeWaiterBit(*event_count); waiter_bit != 0) return {*event_count, waiter_bit};
  }
  auto* const event_count = new SharedEventCount;
  const Waiters waiter_bit = TakeWaiterBit(*event_count);
  event_count->next = all_event_counts.load(std::memory_order_relaxed);
  while (!all_event_counts.compare_exchange_weak(event_count->next, event_count, std::memory_order_release,
                                                 std::memory_order_relaxed)) {
  }
  return {*event_count, waiter_bit};
}

}  // namespace

WakeEvent::WakeEvent() : waiter_(MakeWaiter()) {}

WakeEvent::~WakeEvent() {
  static_cast<SharedEventCount&>(waiter_.event_count())
      .taken.fetch_and(~waiter_.waiter_bit(), std::memory_order_relaxed);
}

void WakeEvent::WaitUntil(Time deadline) noexcept {
  // The steady clock is that of the deadlines, and both count from the machine's start.
  const auto since = std::max(deadline.time_since_epoch(), Duration::zero());
  (void)waiter_.Wait(KernelFutex::Deadline(since));
}

}  // namespace runnel

#pragma once

#include "core/base/clock.h"
#include "core/lockfree/event_count.h"

namespace runnel {

/// Lets one thread sleep until another has something for it. Notifications that come before the
/// thread looks add up to one.
///
/// Threads:     Notify() from any thread: it never blocks, and calls the system only if the other
///              thread sleeps. Wait() and WaitUntil() by one thread at a time.
/// Allocation:  in the constructor, and only if more of them exist than ever before: the event counts that
///              threads sleep on stay, and are used again.
class WakeEvent {
 public:
  WakeEvent();
  ~WakeEvent();
  WakeEvent(const WakeEvent&) = delete;
  WakeEvent& operator=(const WakeEvent&) = delete;

  void Notify() noexcept { waiter_.Notify(); }
  void Wait() noexcept { (void)waiter_.Wait(KernelFutex::kNever); }
  /// Until `deadline` by the steady clock, if nothing comes before.
  void WaitUntil(Time deadline) noexcept;

 private:
  friend class NotificationBatch;
  Waiter<> waiter_;
};

/// Notifies several, and wakes those who sleep on the same event count by one call of the system: nearly all
/// of them, if they were made one after the other. They wake when it is destroyed, some before.
///
/// Threads: one. Allocation: none.
class NotificationBatch {
 public:
  NotificationBatch() = default;
  ~NotificationBatch() { Notify(); }
  NotificationBatch(const NotificationBatch&) = delete;
  NotificationBatch& operator=(const NotificationBatch&) = delete;

  void Add(WakeEvent& event) noexcept {
    if (!event.waiter_.MarkNotified()) return;
    if (event_count_ != &event.waiter_.event_count()) Notify();
    event_count_ = &event.waiter_.event_count();
    waiters_ |= event.waiter_.waiter_bit();
  }

 private:
  void Notify() noexcept {
    if (waiters_ != 0) event_count_->Notify(waiters_);
    waiters_ = 0;
  }

  EventCount<>* event_count_ = nullptr;
  EventCount<>::Waiters waiters_ = 0;  // on this event count, those who are still to be woken
};

}  // namespace runnel

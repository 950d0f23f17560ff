#pragma once

#include "core/base/clock.h"
#include "core/lockfree/bell.h"

namespace runnel {

/// Lets one thread sleep until another has something for it. Notifications that come before the
/// thread looks add up to one.
///
/// Threads:     Notify() from any thread: it never blocks, and calls the system only if the other
///              thread sleeps. Wait() and WaitUntil() by one thread at a time.
/// Allocation:  in the constructor, and only if more of them exist than ever before: the bells that
///              threads sleep on stay, and are used again.
class WakeEvent {
 public:
  WakeEvent();
  ~WakeEvent();
  WakeEvent(const WakeEvent&) = delete;
  WakeEvent& operator=(const WakeEvent&) = delete;

  void Notify() noexcept { sleeper_.Notify(); }
  void Wait() noexcept { (void)sleeper_.Wait(KernelFutex::kNever); }
  /// Until `deadline` by the steady clock, if nothing comes before.
  void WaitUntil(Time deadline) noexcept;

 private:
  friend class WakeUps;
  Sleeper<> sleeper_;
};

/// Notifies several, and wakes those who sleep on the same bell by one call of the system: nearly all
/// of them, if they were made one after the other. They wake when it is destroyed, some before.
///
/// Threads: one. Allocation: none.
class WakeUps {
 public:
  WakeUps() = default;
  ~WakeUps() { Ring(); }
  WakeUps(const WakeUps&) = delete;
  WakeUps& operator=(const WakeUps&) = delete;

  void Add(WakeEvent& event) noexcept {
    if (!event.sleeper_.Notice()) return;
    if (bell_ != &event.sleeper_.bell()) Ring();
    bell_ = &event.sleeper_.bell();
    seats_ |= event.sleeper_.seat();
  }

 private:
  void Ring() noexcept {
    if (seats_ != 0) bell_->Ring(seats_);
    seats_ = 0;
  }

  Bell<>* bell_ = nullptr;
  Bell<>::Seats seats_ = 0;  // on this bell, those who are still to be woken
};

}  // namespace runnel

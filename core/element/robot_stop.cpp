#include "core/element/robot_stop.h"

#include <iterator>
#include <new>

#include "core/element/runtime.h"

namespace runnel {

StopSignal::Subscription& StopSignal::Subscription::operator=(Subscription&& other) noexcept {
  if (this == &other) return *this;
  End();
  signal_ = std::move(other.signal_);
  place_ = other.place_;
  return *this;
}

void StopSignal::Subscription::End() noexcept {
  const auto signal = std::move(signal_);
  if (!signal) return;
  const std::lock_guard lock(signal->mutex_);
  signal->listeners_.erase(place_);
}

bool StopSignal::Press(const Listener& note) {
  // release: pairs with the acquire in bar(). It is in force now; listeners may be busy with a change before.
  if (bar_.exchange(kInForce, std::memory_order_acq_rel) == kInForce) return false;
  Tell(note);
  return true;
}

bool StopSignal::Release(const std::function<Time()>& now, const Listener& note) {
  std::unique_lock releaser(releasers_);
  std::int64_t pressed = kInForce;
  if (!bar_.compare_exchange_strong(pressed, now().time_since_epoch().count(), std::memory_order_acq_rel)) return false;
  releaser.unlock();
  Tell(note);
  return true;
}

void StopSignal::Bar(const std::function<Time()>& at) {
  const std::lock_guard releaser(releasers_);
  const std::int64_t bar = at().time_since_epoch().count();
  // release: as above. In force it is later than any time.
  for (std::int64_t known = this->bar(); known < bar;) {
    if (bar_.compare_exchange_weak(known, bar, std::memory_order_acq_rel)) return Tell({});
  }
}

StopSignal::Subscription StopSignal::Listen(Listener listener) {
  Subscription subscription;
  const std::lock_guard lock(mutex_);
  listeners_.push_back(std::move(listener));
  subscription.signal_ = shared_from_this();
  subscription.place_ = std::prev(listeners_.end());
  return subscription;
}

void StopSignal::Tell(const Listener& note) {
  if (note) note();
  const std::lock_guard lock(mutex_);
  for (const Listener& listener : listeners_) {
    try {
      listener();
    } catch (...) {  // those behind it have to know all the same
    }
  }
}

namespace {
Error PressedSince() {
  return {.message = "STOP was pressed or released after this was asked for", .hint = "look why, then ask again"};
}
}  // namespace

RobotStop::RobotStop(const Runtime& runtime) : runtime_(runtime) {}

bool RobotStop::Press(std::string_view by) noexcept {
  std::string name;
  try {
    name = by;
  } catch (const std::bad_alloc&) {
    name = "somebody";  // short enough to need no memory
  }
  for (;;) {
    const auto note = [&] {
      const std::lock_guard lock(mutex_);
      Note(true, std::move(name));
    };
    if (signal_->Press(note)) return true;
    const std::lock_guard lock(mutex_);
    if (!in_force()) continue;  // somebody has released it since: who presses now ends that
    requests_.fetch_add(1, std::memory_order_release);
    state_.requested = SteadyClock().Now();
    return false;
  }
}

// With the mutex from the comparison on until it is released: who presses meanwhile is counted before, or presses anew.
Result<void> RobotStop::Release(std::string by, const AsOf& as_of) {
  std::unique_lock lock(mutex_);
  if (!in_force()) return Error{.message = "STOP is not in force"};
  if (!IsKnown(as_of)) return PressedSince();
  // Two releases have two bars, also while the clock stands.
  const auto bar = [&] {
    const Time now = runtime_.clock().Now();
    return now == state_.since ? now + Duration(state_.changes) : now;
  };
  signal_->Release(bar, [&] {
    Note(false, std::move(by));
    lock.unlock();
  });
  return {};
}

Result<void> RobotStop::CheckIsKnown(const AsOf& as_of) const {
  const std::lock_guard lock(mutex_);
  if (!IsKnown(as_of)) return PressedSince();
  return {};
}

RobotStop::State RobotStop::state() const {
  const std::lock_guard lock(mutex_);
  State state = state_;
  state.in_force = in_force();  // it may have changed, and not be noted yet
  state.requests = requests();
  return state;
}

bool RobotStop::IsKnown(const AsOf& as_of) const {
  if (in_force() && !state_.in_force) return false;  // it is being pressed just now
  return (!as_of.asked || *as_of.asked >= state_.requested) && (!as_of.requests || *as_of.requests == requests());
}

void RobotStop::Note(bool in_force, std::string by) {
  state_ = {.in_force = in_force,
            .by = std::move(by),
            .since = runtime_.clock().Now(),
            .changes = state_.changes + 1,
            .requested = SteadyClock().Now()};
  requests_.fetch_add(1, std::memory_order_release);
}

}  // namespace runnel

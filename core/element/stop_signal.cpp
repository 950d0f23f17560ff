#include "core/element/stop_signal.h"

#include <iterator>
#include <utility>

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

}  // namespace runnel

#include "plugins/services/call.h"

#include <algorithm>
#include <mutex>

#include "core/base/retry.h"
#include "core/lockfree/thread_epoch.h"

namespace runnel {

void CallBase::WakeCaller() noexcept {
  Waker* seen = nullptr;
  // A change, though of nothing. release: pairs with the acquire in CallSlots::SetWaker(): of both, which change the same
  // word, one comes second, and finds the waker or the answer.
  if (waker.compare_exchange_strong(seen, nullptr, std::memory_order_acq_rel)) return;
  if (!is_held.load(std::memory_order_relaxed)) return;
  const EpochGuard guard;  // by which the waker lives
  if (Waker* const whom = waker.load(std::memory_order_relaxed)) whom->Wake();
}

void CallBase::NoteStop(const RobotStop& stop) noexcept {
  stop_bar = stop.signal()->bar();
  stop_requests = stop.requests();
}

// In force is what is being pressed before it is counted.
bool CallBase::IsFromBefore(const RobotStop& stop) const noexcept {
  return stop.signal()->bar() != stop_bar || stop.requests() != stop_requests;
}

void CallSlots::SetWaker(Waker* waker) noexcept {
  // acquire: pairs with the release in WakeCaller().
  for (CallBase* call : calls_) (void)call->waker.exchange(waker, std::memory_order_acq_rel);
  const auto waits = [](const CallBase* call) {
    return call->is_held.load(std::memory_order_relaxed) && call->is_answered();
  };
  if (waker != nullptr && std::ranges::any_of(calls_, waits)) waker->Wake();
}

CallBase* CallSlots::Acquire() noexcept {
  for (CallBase* call : calls_) {
    // acquire: pairs with the release in Release(). The load before spares those in use being written to.
    if (call->is_held.load(std::memory_order_relaxed) || call->is_held.exchange(true, std::memory_order_acquire))
      continue;
    if (call->is_returned()) return call;
    Release(*call);
  }
  return nullptr;
}

bool CallSlots::is_quiet() const noexcept {
  return std::ranges::all_of(calls_, [](const CallBase* call) {
    return call->is_returned() && !call->is_held.load(std::memory_order_acquire);
  });
}

void CallSlots::GiveUpAll() noexcept {
  for (CallBase* call : calls_) {
    if (call->is_held.load(std::memory_order_relaxed)) call->is_given_up.store(true, std::memory_order_relaxed);
  }
}

void RetireCalls(std::unique_ptr<CallSlots> calls) {
  static std::mutex mutex;
  static std::vector<std::unique_ptr<CallSlots>> retired;
  const std::lock_guard lock(mutex);
  std::erase_if(retired, [](const auto& each) { return each->is_quiet(); });
  if (!calls || calls->is_quiet()) return;
  // For destructors, which have nobody to tell. What is not kept is lost: a service still writes there.
  if (!Retry([&] { retired.push_back(std::move(calls)); })) (void)calls.release();
}

}  // namespace runnel

#include "plugins/services/client_base.h"

#include <mutex>
#include <utility>

#include "core/base/check.h"
#include "core/element/runtime.h"
#include "core/lockfree/thread_epoch.h"
#include "core/port/connection_rules.h"
#include "core/port/cycle.h"

namespace runnel {

namespace {

// How often a thread that waits looks at the application's clock, which may stand still or jump.
constexpr Duration kLookAtClock = std::chrono::milliseconds(10);

// A client asks one service.
void HoldClientsToOneService() {
  static std::once_flag once;
  std::call_once(once, [] {
    AddConnectionRule(
        {"services/one", "a client is connected to one service", [](const Port& from, const Port& to) -> Result<void> {
           if (to.direction() != Port::Direction::kInput || to.incoming().empty() ||
               !to.type().name().starts_with("service "))
             return {};
           if (to.incoming().front() == &from) return {};
           return Error{.message =
                            "it is connected to " + to.incoming().front()->path() + ", and a client asks one service"};
         }});
  });
}

}  // namespace

ClientBase::ClientBase(const ClientOptions& options, std::unique_ptr<CallSlots> slots)
    : timeout_(options.timeout), slots_(std::move(slots)) {
  awaited_.reserve(slots_->size());
}

void ClientBase::Open(Port& port) {
  port_ = &port;
  HoldClientsToOneService();
  work_ = CycleWork::Add(port, *this);
}

void ClientBase::Close() noexcept {
  if (work_ != nullptr) work_->Remove(*this);
  slots_->GiveUpAll();
  slots_->SetWaker(nullptr);
  for (CallBase* call : awaited_) CallSlots::Release(*call);
  RetireCalls(std::move(slots_));
}

Time ClientBase::now() const noexcept {
  const Cycle* const cycle = CurrentCycle();
  return cycle != nullptr ? cycle->now : port_->runtime().clock().Now();
}

CallStatus ClientBase::Begin(CallBase& call) noexcept {
  call.number = calls_.fetch_add(1, std::memory_order_relaxed) + 1;
  call.NoteStop(port_->runtime().robot_stop());
  return Guarded([&] { return BeginCall(endpoint(), call, now(), timeout_); });
}

CallStatus ClientBase::Poll(CallBase& call) const noexcept {
  if (call.is_answered()) return call.status;
  CallStatus status = CallStatus::kPending;
  if (now() >= call.deadline) {
    status = CallStatus::kTimedOut;
  } else if (Guarded([&] { return endpoint(); }) != call.endpoint) {
    status = CallStatus::kDisconnected;
  }
  if (status != CallStatus::kPending) call.is_given_up.store(true, std::memory_order_relaxed);
  return status;
}

CallStatus ClientBase::Wait(CallBase& call) const {
  RUNNEL_CHECK(CurrentCycle() == nullptr && !EpochGuard::HeldByThisThread(),
               "a cycle must not wait for an answer: ask for a callback, or look whether it is there");
  CallStatus status = Poll(call);
  for (; status == CallStatus::kPending; status = Poll(call)) {
    call.answered.WaitUntil(SteadyClock().Now() + kLookAtClock);
  }
  return status;
}

void ClientBase::CallBackAll() {
  // What callbacks call comes behind, and has its turn at the earliest in the next cycle.
  std::size_t kept = 0;
  const std::size_t count = awaited_.size();
  std::size_t next = 0;
  const auto end = [&] { awaited_.erase(awaited_.begin() + kept, awaited_.begin() + next); };
  try {
    while (next < count) {
      CallBase& call = *awaited_[next++];
      const CallStatus status = Poll(call);
      if (status == CallStatus::kPending) {
        awaited_[kept++] = &call;
        continue;
      }
      CallBack(call, status);
      CallSlots::Release(call);
    }
  } catch (...) {
    CallSlots::Release(*awaited_[next - 1]);
    end();
    throw;
  }
  end();
}

}  // namespace runnel

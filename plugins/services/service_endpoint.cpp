#include "plugins/services/service_endpoint.h"

#include "core/port/port.h"

namespace runnel {

CallBase* ServiceEndpoint::Take(Time now, const RobotStop& stop) {
  for (CallBase* call = nullptr; queue.TryPop(call);) {
    if (call->is_given_up.load(std::memory_order_relaxed) || now >= call->deadline) {
      End(*call, CallStatus::kTimedOut, "given up by its caller, or its turn did not come in time");
    } else if (call->IsFromBefore(stop)) {
      End(*call, CallStatus::kFailed, kCalledBeforeStop);
    } else {
      return call;
    }
  }
  return nullptr;
}

ServiceEndpoint* EndpointAt(const Port& port) {
  ServiceEndpoint* found = nullptr;
  port.VisitLatest([&found](const void* link, ValueTimes) { found = *static_cast<ServiceEndpoint* const*>(link); });
  return found;
}

std::string SignatureName(const TypeInfo* reply, const std::vector<const TypeInfo*>& arguments) {
  std::string name = (reply != nullptr ? reply->name() : "void") + "(";
  for (const TypeInfo* each : arguments) name += (name.ends_with('(') ? "" : ", ") + each->name();
  return name + ")";
}

CallStatus BeginCall(ServiceEndpoint* at, CallBase& call, Time now, Duration timeout) noexcept {
  if (at == nullptr) return CallStatus::kNotConnected;
  if (at->is_faulted.load(std::memory_order_relaxed)) return CallStatus::kFaulted;
  call.called_at = now;
  call.deadline = now + timeout;
  call.endpoint = at;
  call.status = CallStatus::kPending;
  call.error.clear();
  call.begun_at = call.asked_to_end_at = Time();
  call.is_given_up.store(false, std::memory_order_relaxed);
  call.progress.store(0, std::memory_order_relaxed);
  // relaxed: the queue hands it over, with all of the above.
  call.state.store(CallBase::State::kQueued, std::memory_order_relaxed);
  if (at->queue.TryPush(&call)) {
    at->Wake();
    return CallStatus::kPending;
  }
  call.state.store(CallBase::State::kIdle, std::memory_order_relaxed);
  return CallStatus::kBusy;
}

}  // namespace runnel

#include "plugins/genom_modules/component_service.h"

#include <algorithm>

#include "plugins/genom_modules/component_module.h"

namespace runnel::genom_modules {

using genom_execution::Engine;
using genom_execution::Request;

void ComponentServiceBase::PrepareFor(Engine& engine) {
  module_ = static_cast<ComponentModule*>(engine.options().glue);
  while (all_.size() < kMostUnderWay) all_.emplace_back(engine.component(), service_);
}

ServiceState ComponentServiceBase::state() const {
  ServiceState state = ServiceBase::state();
  for (const UnderWay& each : all_) {
    const std::uint32_t id = each.id.load(std::memory_order_relaxed);
    if (id == 0) continue;
    state.running.push_back({id, 0, each.request.doing(), each.is_abort_asked.load(std::memory_order_relaxed)});
  }
  std::ranges::sort(state.running, {}, &ServiceState::Running::number);
  return state;
}

bool ComponentServiceBase::Abort() {
  bool is_any = false;
  for (UnderWay& each : all_) {
    if (each.id.load(std::memory_order_relaxed) == 0) continue;
    each.is_abort_asked.store(true, std::memory_order_relaxed);
    is_any = true;
  }
  return is_any;
}

bool ComponentServiceBase::IsFree(const UnderWay& each) {
  const auto is_free = [](const Request& request) {
    return request.state() == Request::State::kIdle || request.state() == Request::State::kDone;
  };
  return each.call == nullptr && is_free(each.request) && is_free(each.abort);
}

void ComponentServiceBase::BeforePasses(Engine& engine, Time now) {
  ServiceEndpoint* const at = endpoint();
  if (at->is_faulted.load(std::memory_order_relaxed)) at->is_faulted.store(false, std::memory_order_relaxed);
  if (count_ == 0 && at->queue.size() == 0) return;
  for (UnderWay& each : all_) {
    if (IsFree(each)) {
      Begin(engine, each, now);
    } else if (each.call != nullptr && is_activity()) {
      if (each.call->is_given_up.load(std::memory_order_relaxed)) {
        each.is_abort_asked.store(true, std::memory_order_relaxed);
      }
      Interrupt(engine, each, now);
    }
  }
}

void ComponentServiceBase::Begin(Engine& engine, UnderWay& each, Time now) {
  ServiceEndpoint* const at = endpoint();
  while (CallBase* const call = at->Take(now, port().runtime().robot_stop())) {
    each.call = call;  // first: what is thrown ends it (AfterFault())
    Fill(each.request, *call);
    if (!engine.Send(each.request)) {
      each.call = nullptr;
      at->End(*call, CallStatus::kBusy, "too many requests wait for the component");
      continue;
    }
    call->begun_at = now;
    each.is_interrupted = false;
    each.is_abort_asked.store(false, std::memory_order_relaxed);
    ++count_;
    return;
  }
}

// Once it has an id: until then the engine would not know which.
void ComponentServiceBase::Interrupt(Engine& engine, UnderWay& each, Time now) {
  if (each.is_interrupted || !each.is_abort_asked.load(std::memory_order_relaxed) || each.request.id() == 0) return;
  each.abort.abort_id = each.request.id();
  each.is_interrupted = engine.Send(each.abort);
  if (each.is_interrupted) each.call->asked_to_end_at = now;
}

void ComponentServiceBase::AfterPasses() {
  if (count_ == 0) return;
  for (UnderWay& each : all_) {
    if (each.call == nullptr) continue;
    if (each.request.state() == Request::State::kDone) {
      Deliver(each);
    } else if (is_activity()) {
      each.call->doing.store(each.request.doing(), std::memory_order_relaxed);
      each.id.store(each.request.id(), std::memory_order_relaxed);
    }
  }
}

void ComponentServiceBase::Deliver(UnderWay& each) {
  CallBase& call = *each.call;
  CallStatus status = CallStatus::kAnswered;
  if (each.request.outcome().is_success()) {
    Take(each.request, call);
    if (service_.kind == genom_execution::ServiceKind::kAttribute) module_->AfterCall(each.request);
  } else {
    call.error = each.request.outcome().Text(module_->table());
    const bool is_interrupted = each.request.outcome().exception() == genom_execution::kInterrupted;
    status = is_interrupted && each.is_interrupted ? CallStatus::kAborted : CallStatus::kFailed;
  }
  Record(call, status);
  ServiceEndpoint* const at = endpoint();
  (status == CallStatus::kAnswered ? at->answered : at->failed).fetch_add(1, std::memory_order_relaxed);
  each.call = nullptr;
  each.id.store(0, std::memory_order_relaxed);
  --count_;
  call.Answer(status);
}

void ComponentServiceBase::EndCalls(CallStatus status, std::string_view why) noexcept {
  for (UnderWay& each : all_) {
    if (each.call != nullptr) endpoint()->End(*each.call, status, why);
    each.call = nullptr;
    each.id.store(0, std::memory_order_relaxed);
  }
  count_ = 0;
}

void ComponentServiceBase::AfterFault(std::string_view what) noexcept {
  EndCalls(CallStatus::kFaulted, what);
  ServiceBase::AfterFault(what);
}

}  // namespace runnel::genom_modules

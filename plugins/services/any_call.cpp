#include "plugins/services/any_call.h"

#include "core/element/runtime.h"
#include "core/paths/path_search.h"
#include "core/port/port.h"

namespace runnel {

Result<Callable*> FindCallable(Runtime& runtime, const std::string& path) {
  const auto found = PathSearch(runtime).FindPort(path, PathKind::kOutput);
  if (!found) return found.error();
  if (auto* const callable = (*found)->FindAnnotation<Callable>()) return callable;
  std::string hint;
  runtime.root().Visit([&](FrameworkElement& each) {
    if (each.FindAnnotation<Callable>() == nullptr) return;
    hint += (hint.empty() ? "services are " : ", ") + each.path();
  });
  return Error{.message = "is no service", .path = (*found)->path(), .hint = hint};
}

OwnCall::OwnCall(ServiceBase& service, std::unique_ptr<CallSlots> slots)
    : service_(service), slots_(std::move(slots)), call_(slots_->Acquire()) {}

OwnCall::~OwnCall() {
  slots_->GiveUpAll();
  CallSlots::Release(*call_);
  RetireCalls(std::move(slots_));
}

CallStatus OwnCall::Begin(Time now, Duration timeout, const RobotStop::AsOf& as_of) {
  const RobotStop& stop = service_.port().runtime().robot_stop();
  call_->NoteStop(stop);  // first: what comes after the comparison is seen when the call is taken out
  if (!stop.CheckIsKnown(as_of)) {
    error_ = kCalledBeforeStop;
    return status_ = CallStatus::kFailed;
  }
  return status_ = BeginCall(service_.endpoint(), *call_, now, timeout);
}

CallStatus OwnCall::Poll(Time now) {
  if (status_ != CallStatus::kPending) return status_;
  if (call_->is_answered()) {
    status_ = call_->status;
    error_ = call_->error;
  } else if (now >= call_->deadline) {
    Abort();
    status_ = CallStatus::kTimedOut;
  }
  return status_;
}

}  // namespace runnel

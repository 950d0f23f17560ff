#include "plugins/services/any_call.h"

namespace runnel {

OwnCall::OwnCall(ServiceBase& service, std::unique_ptr<CallSlots> slots)
    : service_(service), slots_(std::move(slots)), call_(slots_->Acquire()) {}

OwnCall::~OwnCall() {
  slots_->GiveUpAll();
  CallSlots::Release(*call_);
  RetireCalls(std::move(slots_));
}

CallStatus OwnCall::Begin(Time now, Duration timeout) {
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

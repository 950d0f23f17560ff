#pragma once

#include <memory>
#include <string>

#include "plugins/services/callable.h"
#include "plugins/services/service_base.h"

namespace runnel {

/// A call with a slot of its own, of whatever types: what AnyCall is about but for its arguments and its reply.
class OwnCall : public AnyCall {
 public:
  OwnCall(const OwnCall&) = delete;
  OwnCall& operator=(const OwnCall&) = delete;
  CallStatus Begin(Time now, Duration timeout) final;
  CallStatus Poll(Time now) final;
  [[nodiscard]] std::string error() const final { return error_; }
  [[nodiscard]] double progress() const final { return call_->progress.load(std::memory_order_relaxed); }
  [[nodiscard]] const char* doing() const final { return call_->doing.load(std::memory_order_relaxed); }
  void Abort() final { call_->is_given_up.store(true, std::memory_order_relaxed); }

 protected:
  /// `slots`: one, of the service's signature.
  OwnCall(ServiceBase& service, std::unique_ptr<CallSlots> slots);
  ~OwnCall() override;
  [[nodiscard]] CallBase& call() const noexcept { return *call_; }

 private:
  ServiceBase& service_;  // until Begin()
  std::unique_ptr<CallSlots> slots_;
  CallBase* const call_;
  CallStatus status_ = CallStatus::kNotConnected;
  std::string error_;
};

}  // namespace runnel

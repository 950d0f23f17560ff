#pragma once

#include <memory>
#include <string>
#include <utility>

#include "core/lockfree/thread_epoch.h"
#include "plugins/services/argument_type.h"
#include "plugins/services/call_record.h"
#include "plugins/services/callable.h"
#include "plugins/services/service_base.h"

namespace runnel {

/// A call with a slot of its own.
template <typename Signature>
class AnyCallOf;
template <typename Reply, typename... Arguments>
class AnyCallOf<Reply(Arguments...)> final : public AnyCall {
 public:
  using Signature = Reply(Arguments...);
  AnyCallOf(ServiceBase& service, void* (*find)(ArgumentPack<Arguments...>&))
      : service_(service), find_(find), call_(static_cast<Call<Signature>*>(slots_->Acquire())) {}
  ~AnyCallOf() override {
    slots_->GiveUpAll();
    CallSlots::Release(*call_);
    RetireCalls(std::move(slots_));
  }

  [[nodiscard]] void* arguments() override { return find_(call_->arguments); }
  void TakeArguments(const CallRecordBase& record) override {
    call_->arguments = static_cast<const CallRecord<Signature>&>(record).arguments;
  }
  CallStatus Begin(Time now, Duration timeout) override {
    return status_ = BeginCall(service_.endpoint(), *call_, now, timeout);
  }
  CallStatus Poll(Time now) override {
    if (status_ != CallStatus::kPending) return status_;
    if (call_->is_answered()) {
      status_ = call_->status;
      error_ = call_->error;
    } else if (now >= call_->deadline) {
      call_->is_given_up.store(true, std::memory_order_relaxed);
      status_ = CallStatus::kTimedOut;
    }
    return status_;
  }
  [[nodiscard]] const void* reply() const override {
    return std::is_void_v<Reply> ? nullptr : &call_->reply;
  }
  [[nodiscard]] std::string error() const override { return error_; }
  [[nodiscard]] double progress() const override { return call_->progress.load(std::memory_order_relaxed); }
  [[nodiscard]] const char* doing() const override { return call_->doing.load(std::memory_order_relaxed); }
  void Abort() override { call_->is_given_up.store(true, std::memory_order_relaxed); }

 private:
  ServiceBase& service_;  // until Begin()
  void* (*const find_)(ArgumentPack<Arguments...>&);
  std::unique_ptr<CallSlots> slots_ = std::make_unique<CallSlotsOf<Signature>>(1);
  Call<Signature>* const call_;
  CallStatus status_ = CallStatus::kNotConnected;
  std::string error_;
};

/// What a service is to those who do not know its types.
template <typename Signature>
class CallableOf;
template <typename Reply, typename... Arguments>
class CallableOf<Reply(Arguments...)> final : public Callable {
 public:
  using Pack = ArgumentPack<Arguments...>;

  CallableOf(ServiceBase& service, const ServiceOptions& options, bool is_activity)
      : service_(service),
        description_(options.description),
        is_activity_(is_activity),
        arguments_(options.arguments) {}

  [[nodiscard]] const TypeInfo* arguments() const override { return arguments_.Get(); }
  [[nodiscard]] const TypeInfo* reply() const override {
    if constexpr (std::is_void_v<Reply>) {
      return nullptr;
    } else {
      return &TypeOf<Reply>();
    }
  }
  [[nodiscard]] const std::string& description() const override { return description_; }
  [[nodiscard]] bool is_activity() const override { return is_activity_; }
  [[nodiscard]] std::unique_ptr<AnyCall> NewCall() override {
    return std::make_unique<AnyCallOf<Reply(Arguments...)>>(service_, [](Pack& pack) -> void* {
      return sizeof...(Arguments) == 0 ? nullptr : &pack;
    });
  }
  [[nodiscard]] ServiceState state() const override { return service_.state(); }
  bool Abort() override { return service_.Abort(); }

 private:
  ServiceBase& service_;
  const std::string description_;
  const bool is_activity_;
  const ArgumentType<Arguments...> arguments_;
};

}  // namespace runnel

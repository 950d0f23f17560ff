#pragma once

#include <memory>
#include <string>

#include "plugins/services/call_record.h"
#include "plugins/services/callable.h"
#include "plugins/services/service_base.h"
#include "plugins/services/service_signature.h"

namespace runnel {

/// A call with a slot of its own, of whatever types: what AnyCall is about but for its arguments and its reply.
class OwnCall : public AnyCall {
 public:
  OwnCall(const OwnCall&) = delete;
  OwnCall& operator=(const OwnCall&) = delete;
  CallStatus Begin(Time now, Duration timeout, const RobotStop::AsOf& as_of) final;
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

/// A call of a service whose types are known.
template <typename Signature>
class AnyCallOf;
template <typename Reply, typename... Arguments>
class AnyCallOf<Reply(Arguments...)> final : public OwnCall {
 public:
  using Signature = Reply(Arguments...);
  AnyCallOf(ServiceBase& service, void* (*find)(ArgumentPack<Arguments...>&))
      : OwnCall(service, std::make_unique<CallSlotsOf<Signature>>(1)), find_(find) {}

  [[nodiscard]] void* arguments() override { return find_(typed().arguments); }
  void TakeArguments(const CallRecordBase& record) override {
    typed().arguments = static_cast<const CallRecord<Signature>&>(record).arguments;
  }
  [[nodiscard]] const void* reply() const override {
    return std::is_void_v<Reply> ? nullptr : &typed().reply;
  }

 private:
  [[nodiscard]] Call<Signature>& typed() const noexcept { return static_cast<Call<Signature>&>(call()); }

  void* (*const find_)(ArgumentPack<Arguments...>&);
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

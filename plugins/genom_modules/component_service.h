#pragma once

#include <memory>
#include <string>
#include <utility>

#include "core/port/output.h"
#include "core/types/text_format.h"
#include "plugins/genom_modules/component_service_base.h"
#include "plugins/services/any_call.h"
#include "plugins/services/call_record.h"
#include "plugins/services/callable.h"

namespace runnel::genom_modules {

/// A service to those who do not know its types: what a call leaves out is as the description says.
template <typename Inner>
class CallableWithDefaults final : public Callable {
 public:
  /// `defaults`: text of the arguments, "" for none. `are_all_there`: each argument has one.
  CallableWithDefaults(std::unique_ptr<Inner> inner, std::string defaults, bool are_all_there)
      : inner_(std::move(inner)), defaults_(std::move(defaults)), are_all_there_(are_all_there) {}

  [[nodiscard]] const TypeInfo* arguments() const override { return inner_->arguments(); }
  [[nodiscard]] const TypeInfo* reply() const override { return inner_->reply(); }
  [[nodiscard]] bool are_arguments_optional() const override { return are_all_there_; }
  [[nodiscard]] const std::string& description() const override { return inner_->description(); }
  [[nodiscard]] bool is_activity() const override { return inner_->is_activity(); }
  [[nodiscard]] std::unique_ptr<AnyCall> NewCall() override {
    auto call = inner_->NewCall();
    // What cannot be said of a type, a union, is not.
    if (!defaults_.empty()) (void)SetFromText(*inner_->arguments(), defaults_, call->arguments());
    return call;
  }
  [[nodiscard]] ServiceState state() const override { return inner_->state(); }
  bool Abort() override { return inner_->Abort(); }

 private:
  const std::unique_ptr<Inner> inner_;
  const std::string defaults_;
  const bool are_all_there_;
};

template <typename Signature>
class ComponentService;

/// A service of a component as one of its module: a call becomes a request of the engine, and is answered when that is
/// done, in whichever cycle. An activity tells the state that it is in, and can be aborted; a call that is given up
/// interrupts it, too. What comes of each is published at NAME_calls, if anybody looks.
///
/// Threads, allocation, life: as Service. Calls that are under way when the module goes end with `interrupted`.
template <typename Reply, typename... Arguments>
class ComponentService<Reply(Arguments...)> final : public ComponentServiceBase {
 public:
  using Signature = Reply(Arguments...);
  using Pack = ArgumentPack<Arguments...>;
  using Answered = typename runnel::internal::ReplyOf<Reply>::Type;
  struct Options {
    ServiceOptions service = {};
    const char* defaults = "";  ///< of its arguments, in the text format
    bool has_all_defaults = false;
    void (*fill)(genom_execution::Request& request, Pack& arguments) = nullptr;
    void (*take)(genom_execution::Request& request, Answered& reply) = nullptr;
  };

  template <typename Owner>
  ComponentService(Owner& owner, const std::string& name, const genom_execution::ServiceTable& service, Options options)
      : ComponentServiceBase(service),
        fill_(options.fill),
        take_(options.take),
        endpoint_(std::make_unique<ServiceEndpoint>(options.service.queue)),
        port_(owner.OutputGroup(), name, {.description = options.service.description}),
        records_(owner.OutputGroup(), name + "_calls",
                 {.description = "what has come of each call of " + name, .pool = {}}) {
    auto callable = std::make_unique<CallableWithDefaults<CallableOf<Signature>>>(
        std::make_unique<CallableOf<Signature>>(*this, options.service, is_activity()), options.defaults,
        options.has_all_defaults);
    port_.Publish(ServiceLink<Signature>{endpoint_.get()});
    (void)endpoint_.release();  // the channel's from here on
    Open(port_, false);
    port_.template Annotate<Callable>(std::move(callable));
    owner.AddPart(*this);
  }
  ~ComponentService() {
    EndCalls(CallStatus::kDisconnected, "the component has gone");
    Close();
  }

 private:
  void Fill(genom_execution::Request& request, CallBase& call) override {
    if (fill_ != nullptr) fill_(request, static_cast<Call<Signature>&>(call).arguments);
  }
  void Take(genom_execution::Request& request, CallBase& call) override {
    if (take_ != nullptr) take_(request, static_cast<Call<Signature>&>(call).reply);
  }
  void Record(CallBase& base, CallStatus status) override {
    if (!records_.is_watched()) return;
    auto loan = records_.Loan();
    if (!loan) return;
    const auto& call = static_cast<Call<Signature>&>(base);
    runnel::internal::FillRecord(*loan, call, status);
    records_.Publish(std::move(loan), call.called_at);
  }

  void (*const fill_)(genom_execution::Request& request, Pack& arguments);
  void (*const take_)(genom_execution::Request& request, Answered& reply);
  std::unique_ptr<ServiceEndpoint> endpoint_;
  Output<ServiceLink<Signature>> port_;
  Output<CallRecord<Signature>> records_;
};

}  // namespace runnel::genom_modules

#include "plugins/services/services_at_run_time.h"

#include <utility>

#include "core/element/framework_element.h"
#include "core/types/text_format.h"
#include "plugins/services/own_call.h"

namespace runnel {

namespace {

FoundSignature Found(const SignatureTypes& types) {
  const auto found = SignatureAtRunTime(types);
  if (!found) throw ElementError(found.error());
  return *found;
}

class CallOfOffer final : public OwnCall {
 public:
  CallOfOffer(ServiceBase& service, const ServiceSignature& signature, std::shared_ptr<const CallForm> form)
      : OwnCall(service, signature.MakeSlots(1)), signature_(signature), form_(std::move(form)) {}

  [[nodiscard]] void* arguments() override {
    return form_->arguments() == nullptr ? nullptr : const_cast<void*>(form_->ArgumentsOf(call()));
  }
  void TakeArguments(const CallRecordBase& record) override { signature_.TakeArguments(record, call()); }
  [[nodiscard]] const void* reply() const override { return form_->reply() == nullptr ? nullptr : form_->ReplyOf(call()); }

 private:
  const ServiceSignature& signature_;
  const std::shared_ptr<const CallForm> form_;
};

}  // namespace

/// What it is to those who call it from outside.
class ServiceAtRunTime::Offer final : public Callable {
 public:
  Offer(ServiceAtRunTime& service, const ServiceSignature& signature, std::string description, Extra extra)
      : service_(service), signature_(signature), description_(std::move(description)), extra_(std::move(extra)) {}
  [[nodiscard]] const TypeInfo* arguments() const override { return service_.form_->arguments(); }
  [[nodiscard]] const TypeInfo* reply() const override { return service_.form_->reply(); }
  [[nodiscard]] const std::string& description() const override { return description_; }
  [[nodiscard]] bool is_activity() const override { return extra_.is_activity; }
  [[nodiscard]] bool are_arguments_optional() const override { return extra_.are_arguments_optional; }
  [[nodiscard]] std::unique_ptr<AnyCall> NewCall() override {
    auto call = std::make_unique<CallOfOffer>(service_, signature_, service_.form_);
    if (!extra_.defaults.empty()) (void)SetFromText(*arguments(), extra_.defaults, call->arguments());
    return call;
  }
  [[nodiscard]] ServiceState state() const override { return service_.state(); }
  bool Abort() override { return service_.Abort(); }

 private:
  ServiceAtRunTime& service_;
  const ServiceSignature& signature_;
  const std::string description_;
  const Extra extra_;
};

ServiceAtRunTime::ServiceAtRunTime(FrameworkElement& group, const std::string& name, const SignatureTypes& types,
                                   ServiceOptions options, Extra extra, Handler handler)
    : handler_(std::move(handler)) {
  const FoundSignature found = Found(types);
  form_ = found.signature->MakeForm(options.arguments);
  if (!extra.defaults.empty()) {
    // Once, so that NewCall() need not fail.
    const auto slots = found.signature->MakeSlots(1);
    void* const at = const_cast<void*>(form_->ArgumentsOf(*slots->Acquire()));
    if (auto set = SetFromText(*form_->arguments(), extra.defaults, at); !set) throw ElementError(set.error());
  }
  port_ = MakeLinkOutput(*found.link, group, name, {.description = options.description});
  auto endpoint = std::make_unique<ServiceEndpoint>(options.queue);
  const auto published = port_->PublishFilled([&](void* link) -> Result<void> {
    *static_cast<ServiceEndpoint**>(link) = endpoint.get();
    return {};
  });
  if (!published) throw ElementError(published.error());
  (void)endpoint.release();  // the channel's from here on
  Open(*port_, extra.is_activity);
  port_->Annotate<Callable>(std::make_unique<Offer>(*this, *found.signature, options.description, std::move(extra)));
  records_ = found.signature->MakeRecorder(group, name);
}

ServiceAtRunTime::~ServiceAtRunTime() { Close(); }

CallStatus ServiceAtRunTime::Invoke(CallBase& call, Activity* activity) {
  const auto done = handler_(*form_, call, activity);
  if (!done) call.error = done.error().ToString();
  const CallStatus status = done ? CallStatus::kAnswered : CallStatus::kFailed;
  if (records_ != nullptr) records_->Record(call, status);
  return status;
}

ClientAtRunTime::ClientAtRunTime(FrameworkElement& group, const std::string& name, const SignatureTypes& types,
                                 const ClientOptions& options, CalledBack called_back)
    : ClientAtRunTime(group, name, Found(types), options, std::move(called_back)) {}

ClientAtRunTime::ClientAtRunTime(FrameworkElement& group, const std::string& name, FoundSignature found,
                                 const ClientOptions& options, CalledBack called_back)
    : ClientBase(options, found.signature->MakeSlots(options.calls)),
      called_back_(std::move(called_back)),
      form_(found.signature->MakeForm(options.arguments)),
      port_(MakeLinkInput(*found.link, group, name, {.description = options.description, .required = options.required})) {
  Open(*port_);
  port_->Annotate<ClientForm>(std::make_unique<ClientForm>(form_));
}

ClientAtRunTime::~ClientAtRunTime() { Close(); }

}  // namespace runnel

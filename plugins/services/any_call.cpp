#include "plugins/services/any_call.h"

#include <algorithm>

#include "core/element/runtime.h"
#include "core/paths/path_search.h"
#include "core/port/port.h"
#include "core/types/text_format.h"
#include "core/types/value_tokens.h"

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

namespace {

// nullptr: it is not there.
const ValueToken* MemberOf(const ValueToken& said, const std::string& member) {
  if (said.kind != ValueToken::Kind::kStructure) return nullptr;
  const ValueToken* name = said.First();
  for (std::size_t i = 0; i < said.count; i += 2, name = name->Next()->Next()) {
    if (name->text == member) return name->Next();
  }
  return nullptr;
}

}  // namespace

Result<void> CheckAllAreSaid(const TypeInfo& type, const ValueToken& said, bool wants_optionals) {
  const ValueToken* element = said.First();
  const bool is_list = type.kind() == TypeKind::kSequence && said.kind == ValueToken::Kind::kList;
  for (std::size_t i = 0; is_list && i < said.count; ++i, element = element->Next()) {
    if (auto all = CheckAllAreSaid(*type.elements().type, *element); !all) return all;
  }
  if (type.kind() != TypeKind::kStructure) return {};
  for (const FieldInfo& field : type.fields()) {
    const ValueToken* const value = MemberOf(said, field.name);
    if (value == nullptr && !wants_optionals && field.type->name().ends_with('?')) continue;
    if (value == nullptr) return Error{.message = "'" + field.name + "' is not given", .hint = "say all members"};
    if (auto all = CheckAllAreSaid(*field.type, *value); !all) return all;
  }
  return {};
}

Result<void> CheckRequired(const Callable& callable, const ValueToken& said) {
  for (const std::string& each : callable.required()) {
    const ValueToken* const value = MemberOf(said, each);
    if (value == nullptr) {
      return Error{.message = "argument '" + each + "' is not given", .hint = "it has no default: say it"};
    }
    if (auto all = CheckAllAreSaid(*callable.arguments()->FindField(each)->type, *value); !all) return all;
  }
  return {};
}

Result<void> SetArguments(const Callable& callable, std::string_view text, AnyCall& call) {
  auto set = SetFromText(*callable.arguments(), text, call.arguments());
  if (!set || callable.required().empty()) return set;
  return CheckRequired(callable, TokensOf(text)->root());
}

namespace {

class OwnCall final : public AnyCall {
 public:
  OwnCall(ServiceBase& service, const ServiceSignature& signature, std::shared_ptr<const CallForm> form)
      : service_(service),
        signature_(signature),
        form_(std::move(form)),
        slots_(signature.MakeSlots(1)),
        call_(slots_->Acquire()) {}
  ~OwnCall() override {
    slots_->GiveUpAll();
    CallSlots::Release(*call_);
    RetireCalls(std::move(slots_));
  }

  [[nodiscard]] void* arguments() override {
    return form_->arguments() == nullptr ? nullptr : const_cast<void*>(form_->ArgumentsOf(*call_));
  }
  void TakeArguments(const CallRecordBase& record) override { signature_.TakeArguments(record, *call_); }
  CallStatus Begin(Time now, Duration timeout, const RobotStop::AsOf& as_of) override {
    const RobotStop& stop = service_.port().runtime().robot_stop();
    call_->NoteStop(stop);  // first: what comes after the comparison is seen when the call is taken out
    if (!stop.CheckIsKnown(as_of)) {
      error_ = kCalledBeforeStop;
      return status_ = CallStatus::kFailed;
    }
    return status_ = BeginCall(service_.endpoint(), *call_, now, timeout);
  }
  CallStatus Poll(Time now) override {
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
  [[nodiscard]] const void* reply() const override {
    return form_->reply() == nullptr ? nullptr : form_->ReplyOf(*call_);
  }
  [[nodiscard]] std::string error() const override { return error_; }
  [[nodiscard]] double progress() const override { return call_->progress.load(std::memory_order_relaxed); }
  [[nodiscard]] const char* doing() const override { return call_->doing.load(std::memory_order_relaxed); }
  void Abort() override { call_->is_given_up.store(true, std::memory_order_relaxed); }

 private:
  ServiceBase& service_;  // until Begin()
  const ServiceSignature& signature_;
  const std::shared_ptr<const CallForm> form_;
  std::unique_ptr<CallSlots> slots_;
  CallBase* const call_;
  CallStatus status_ = CallStatus::kNotConnected;
  std::string error_;
};

}  // namespace

std::unique_ptr<AnyCall> CallableService::NewCall() {
  auto call = std::make_unique<OwnCall>(service_, signature_, form_);
  // What cannot be said of a type, a union, is not.
  if (!options_.defaults.empty()) (void)SetFromText(*arguments(), options_.defaults, call->arguments());
  return call;
}

}  // namespace runnel

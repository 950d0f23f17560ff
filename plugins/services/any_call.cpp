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

Result<void> CheckRequired(const Callable& callable, const ValueToken& said) {
  std::vector<std::string> given;
  const bool has_names = said.kind == ValueToken::Kind::kStructure;
  const ValueToken* name = said.First();
  for (std::size_t i = 0; has_names && i < said.count; i += 2, name = name->Next()->Next()) given.push_back(name->text);
  for (const std::string& each : callable.required()) {
    if (std::ranges::find(given, each) != given.end()) continue;
    return Error{.message = "argument '" + each + "' is not given", .hint = "it has no default: say it"};
  }
  return {};
}

Result<void> SetArguments(const Callable& callable, std::string_view text, AnyCall& call) {
  auto set = SetFromText(*callable.arguments(), text, call.arguments());
  if (!set || callable.required().empty()) return set;
  return CheckRequired(callable, TokensOf(text)->root());
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

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "core/conversion/conversion.h"
#include "core/element/attempt.h"
#include "core/paths/distant_ports.h"
#include "core/paths/path_search.h"
#include "core/port/port.h"
#include "core/types/text_format.h"
#include "plugins/inspector/internal/requests.h"
#include "plugins/services/callable.h"
#include "plugins/values/json_writer.h"

namespace runnel::internal {

namespace {

constexpr std::size_t kMostConversions = 100;

// Also of a port of another application, to which nothing here is connected yet.
Result<DistantType> SourceType(const PathSearch& paths, Runtime& runtime, const std::string& path) {
  const auto from = paths.FindPort(path, PathKind::kOutput);
  if (from) return DistantType{&(*from)->type(), (*from)->unit()};
  const DistantPorts* const distant = DistantPorts::FindIn(runtime.root());
  if (!IsDistantPath(path) || distant == nullptr) return from.error();
  DistantType type = distant->TypeOf(path);
  return type.type != nullptr ? Result<DistantType>(std::move(type)) : from.error();
}

}  // namespace

std::string FindConversions(Inspection& inspection, const ViewerMessage& message) {
  Runtime& runtime = inspection.application().runtime;
  const std::lock_guard lock(runtime.structure_mutex());
  const PathSearch paths(runtime.root());
  const auto from = SourceType(paths, runtime, message.from);
  if (!from) return Refusal(message.request, {{from.error()}});
  const auto to = paths.FindPort(message.to, PathKind::kInput);
  if (!to) return Refusal(message.request, {{to.error()}});
  const auto candidates =
      ConversionCandidates({*from->type, (*to)->type(), {}, {}, from->unit, (*to)->unit()}, kMostConversions);
  return JsonObjectText([&](JsonObject& json) {
    json.Add("op", "reply").AddOrNull("request", message.request).Add("ok", true);
    AppendList(candidates, json.Key("conversions"), [](const ConversionCandidate& each, std::string& text) {
      JsonObject(text).Add("part", each.part).Add("convert", each.name);
    });
  });
}

namespace {

constexpr Duration kTimeout = std::chrono::minutes(10);  // of what a person waits for, who may close the page

/// The server's thread looks again and again whether it has ended, and waits for nothing.
class ViewerCall {
 public:
  ViewerCall(Runtime& runtime, RobotStop::AsOf as_of, std::string path, std::string arguments)
      : runtime_(runtime), as_of_(as_of), path_(std::move(path)), arguments_(std::move(arguments)) {}

  bool IsDone() {
    if (outcome_) return true;
    outcome_ = Attempt([&] { return Continue(); });  // a type may throw when it is read or shown
    return outcome_.has_value();
  }
  /// Precondition: it is done.
  [[nodiscard]] const Result<std::string>& outcome() const { return *outcome_; }

 private:
  std::optional<Result<std::string>> Continue() {
    if (!call_) {
      const std::unique_lock lock(runtime_.structure_mutex(), std::try_to_lock);
      if (!lock) return {};
      if (auto begun = Begin(); !begun) return begun.error();
    }
    const CallStatus status = call_->Poll(runtime_.clock().Now());
    if (status == CallStatus::kPending) return {};
    if (status == CallStatus::kAnswered) return reply_ != nullptr ? ToText(*reply_, call_->reply()) : "done";
    const std::string why = call_->error();
    return Error{.message = why.empty() ? CallStatusName(status) : why, .path = path_};
  }
  Result<void> Begin() {
    const auto callable = FindCallable(runtime_, path_);
    if (!callable) return callable.error();
    auto call = (*callable)->NewCall();
    if ((*callable)->arguments() != nullptr) {
      if (auto set = SetArguments(**callable, arguments_, *call); !set) return set.error();
    }
    reply_ = (*callable)->reply();
    (void)call->Begin(runtime_.clock().Now(), kTimeout, as_of_);
    call_ = std::move(call);
    return {};
  }

  Runtime& runtime_;
  RobotStop::AsOf as_of_;
  const std::string path_;
  const std::string arguments_;
  std::unique_ptr<AnyCall> call_;
  const TypeInfo* reply_ = nullptr;
  std::optional<Result<std::string>> outcome_;
};

}  // namespace

ViewerRequest BeginCallRequest(Inspection& inspection, ViewerMessage message, std::function<void()> /*on_done*/) {
  const auto call =
      std::make_shared<ViewerCall>(inspection.application().runtime, message.as_of, message.path, message.value);
  return {.take_reply =
              [call, request = message.request] {
                const auto& outcome = call->outcome();
                return outcome ? Reply(request, *outcome) : Refusal(request, {{outcome.error()}});
              },
          .is_done = [call] { return call->IsDone(); }};
}

std::string AbortCall(Inspection& inspection, const ViewerMessage& message) {
  Runtime& runtime = inspection.application().runtime;
  const std::lock_guard lock(runtime.structure_mutex());
  const auto found = FindCallable(runtime, message.path);
  if (!found) return Refusal(message.request, {{found.error()}});
  if ((*found)->Abort()) return Reply(message.request, "it is asked to end");
  return Refusal(message.request, {{Error{.message = "no call is under way there", .path = message.path}}});
}

}  // namespace runnel::internal

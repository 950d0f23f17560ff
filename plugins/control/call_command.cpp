#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "core/types/duration_text.h"
#include "core/types/text_format.h"
#include "plugins/control/command.h"
#include "plugins/services/callable.h"

namespace runnel {

namespace {

constexpr Duration kUsualTimeout = std::chrono::seconds(30);
constexpr Duration kTellProgress = std::chrono::milliseconds(250);

std::string StatusText(CallStatus status) {
  std::string text = CallStatusName(status);
  for (char& each : text) each = each == '_' ? ' ' : each;
  return text;
}

/// One call on behalf of a client, who sees how far it is. When the client goes, it is given up.
class CallCommand {
 public:
  CallCommand(Runtime& runtime, std::optional<Time> asked, std::string path, std::optional<std::string> arguments,
              Duration timeout)
      : runtime_(runtime),
        as_of_(runtime.robot_stop().AsOfNow(asked)),
        path_(std::move(path)),
        arguments_(std::move(arguments)),
        timeout_(timeout) {}

  CommandStep Continue(Answer& answer) {
    if (!call_) {
      const std::unique_lock lock(runtime_.structure_mutex(), std::try_to_lock);
      if (!lock) return kLookAgain;
      if (auto begun = Begin(); !begun) return Refuse(answer, begun.error());
    }
    const CallStatus status = call_->Poll(runtime_.clock().Now());
    ShowProgress(answer);
    if (status == CallStatus::kPending) return kLookAgain;
    if (status == CallStatus::kAnswered) {
      return Say(answer, (reply_ != nullptr ? ToText(*reply_, call_->reply()) : "done") + "\n");
    }
    const std::string why = call_->error();
    return Fail(answer, {.message = "the call has " + Verb(status) + (why.empty() ? "" : ": " + why), .path = path_});
  }

 private:
  static std::string Verb(CallStatus status) {
    switch (status) {
      case CallStatus::kFailed:
      case CallStatus::kTimedOut:
        return StatusText(status);
      case CallStatus::kFaulted:
        return "ended, as the module has failed";
      case CallStatus::kBusy:
        return "not begun, as too many wait";
      default:
        return "ended: " + StatusText(status);
    }
  }

  Result<void> Begin() {
    const auto callable = FindCallable(runtime_, path_);
    if (!callable) return callable.error();
    const TypeInfo* const type = (*callable)->arguments();
    auto call = (*callable)->NewCall();
    if (type == nullptr) {
      if (arguments_ && *arguments_ != "{}") return Error{.message = "takes no arguments", .path = path_};
    } else {
      const std::string shape = ToText(*type, call->arguments());
      if (!arguments_ && !(*callable)->are_arguments_optional()) {
        return Error{.message = "wants arguments",
                     .path = path_,
                     .hint = "of the shape " + (shape.empty() ? "'some words'" : "'" + shape + "'")};
      }
      const auto set = arguments_ ? SetArguments(**callable, *arguments_, *call) : Result<void>();
      if (!set) {
        Error error = set.error();
        error.path = path_;
        if (error.hint.empty()) error.hint = "arguments are of the shape '" + shape + "'";
        return error;
      }
    }
    reply_ = (*callable)->reply();
    (void)call->Begin(runtime_.clock().Now(), timeout_, as_of_);
    call_ = std::move(call);
    return {};
  }
  void ShowProgress(Answer& answer) {
    const std::string doing = call_->doing();
    const auto percent = static_cast<int>(std::lround(100 * call_->progress()));
    std::string text = std::to_string(percent) + " %" + (doing.empty() ? "" : " " + doing) + "\n";
    if (text == shown_ || (shown_.empty() && percent == 0 && doing.empty())) return;
    const auto now = std::chrono::steady_clock::now();
    if (!shown_.empty() && now - shown_at_ < kTellProgress) return;
    shown_at_ = now;
    shown_ = std::move(text);
    answer.WriteError(shown_);
  }

  Runtime& runtime_;
  const RobotStop::AsOf as_of_;
  const std::string path_;
  const std::optional<std::string> arguments_;
  const Duration timeout_;
  std::unique_ptr<AnyCall> call_;
  const TypeInfo* reply_ = nullptr;
  std::string shown_;
  std::chrono::steady_clock::time_point shown_at_{};
};

std::string ServiceLine(const FrameworkElement& port, const Callable& callable) {
  const ServiceState state = callable.state();
  std::string line = port.path() + ": ";
  for (const auto& each : state.running) {
    if (state.running.size() > 1) line += "#" + std::to_string(each.number) + " ";
    line += std::to_string(std::lround(100 * each.progress)) + " %" + (each.doing.empty() ? "" : " " + each.doing) +
            (each.is_abort_asked ? ", asked to end" : "") + "; ";
  }
  return line + std::to_string(state.waiting) + " waiting, " + std::to_string(state.answered) + " answered, " +
         std::to_string(state.failed) + " failed\n";
}

CommandStep ListActivities(Runtime& runtime, bool all, Answer& answer) {
  std::string text;
  runtime.root().Visit([&](FrameworkElement& each) {
    const auto* const callable = each.FindAnnotation<Callable>();
    if (callable != nullptr && (all || callable->is_activity())) text += ServiceLine(each, *callable);
  });
  return Say(answer, text.empty() ? all ? "no module offers a service\n" : "no module offers an activity\n" : text);
}

}  // namespace

CommandResult MakeCallCommand(const Request& request, const CommandContext& context) {
  Duration timeout = kUsualTimeout;
  if (request.Has("timeout")) {
    const auto given = ParseDuration(request.Option("timeout"));
    if (!given) return given.error();
    if (*given <= Duration::zero()) return Error{.message = "a time-out is longer than nothing"};
    timeout = *given;
  }
  std::optional<std::string> arguments;
  if (request.arguments.size() > 1) arguments = request.arguments[1];
  const auto call = std::make_shared<CallCommand>(context.application.runtime, context.asked, request.arguments[0],
                                                  std::move(arguments), timeout);
  return Command([call](Answer& answer) { return call->Continue(answer); });
}

CommandResult MakeActivitiesCommand(const Request& request, const CommandContext& context) {
  Runtime& runtime = context.application.runtime;
  if (request.Has("abort") == request.arguments.empty()) {
    return Error{.message = request.arguments.empty() ? "'activities abort=yes' wants a path"
                                                      : "'activities PATH' wants abort=yes"};
  }
  return Command(UnderLock(runtime, [&runtime, request](Answer& answer) -> CommandStep {
    if (request.arguments.empty()) return ListActivities(runtime, request.Has("all"), answer);
    const auto found = FindCallable(runtime, request.arguments[0]);
    if (!found) return Refuse(answer, found.error());
    if ((*found)->Abort()) return Say(answer, request.arguments[0] + " is asked to end\n");
    return Fail(answer, {.message = "no call is under way there", .path = request.arguments[0]});
  }));
}

}  // namespace runnel

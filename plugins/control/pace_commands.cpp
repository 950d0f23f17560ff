#include <string>

#include <fmt/format.h>

#include "core/base/number_text.h"
#include "plugins/control/command.h"
#include "plugins/scheduling/pace.h"

namespace runnel {

namespace {

constexpr Duration kLookWhetherDone = std::chrono::milliseconds(5);

std::string TimeText(const ServedApplication& application) {
  return fmt::format("{:.3f} s", ToSeconds(application.runtime.clock().Now() - application.log.start()));
}

std::string SpeedText(double speed) {
  if (speed == 0) return "as fast as it can";
  if (speed == 1) return "as fast as real time";
  return fmt::format("{:.6g} times as fast as real time", speed);
}

// Says what has been done; what could not be is the command's error.
CommandResult SayAtOnce(std::string text) {
  return Command([text = std::move(text)](Answer& answer) { return Say(answer, text + "\n"); });
}

// What it wants, done and logged. Errors: of the pace.
CommandResult Do(const ServedApplication& application, const Result<void>& done, const std::string& what) {
  if (!done) return done.error();
  application.log.Add(ApplicationLog::Kind::kChange, what);
  return SayAtOnce(what + " at " + TimeText(application));
}

}  // namespace

CommandResult MakePauseCommand(const Request& request, const CommandContext& context) {
  if (!request.arguments.empty()) return MakeServiceCommand(request, context);
  return Do(context.application, context.application.pace->Pause(), "paused");
}

CommandResult MakeResumeCommand(const Request& request, const CommandContext& context) {
  if (!request.arguments.empty()) return MakeServiceCommand(request, context);
  return Do(context.application, context.application.pace->Resume(), "resumed");
}

CommandResult MakeStepCommand(const Request& request, const CommandContext& context) {
  const std::string word = request.arguments.empty() ? "1" : request.arguments[0];
  const auto count = NumberIn<std::uint64_t>(word);
  if (!count) {
    return Error{.message = "'" + word + "' is not a count of cycles",
                 .hint = "allowed is 1 .. " + std::to_string(Pace::kMostCycles)};
  }
  if (auto stepped = context.application.pace->StepCycles(*count); !stepped) return stepped.error();
  // Waits until the cycles have run.
  return Command(
      [&application = context.application, &pace = *context.application.pace](Answer& answer) -> CommandStep {
        if (!pace.is_paused()) {
          answer.WriteError("somebody else has let it go on meanwhile\n");
          return ControlCode::kFailed;
        }
        if (pace.cycles_to_step() > 0) return kLookWhetherDone;
        return Say(answer, "stands at " + TimeText(application) + "\n");
      });
}

CommandResult MakeSpeedCommand(const Request& request, const CommandContext& context) {
  Pace& pace = *context.application.pace;
  if (request.arguments.empty()) {
    if (pace.has_ended()) {
      return Error{.message = "the run has ended", .hint = "'runnel restart' runs the application again"};
    }
    return SayAtOnce(SpeedText(pace.speed()) + (pace.is_paused() ? ", but paused" : ""));
  }
  const auto speed = NumberIn<double>(request.arguments[0]);
  if (!speed) return Error{.message = "'" + request.arguments[0] + "' is not a number"};
  return Do(context.application, pace.SetSpeed(*speed), SpeedText(*speed));
}

}  // namespace runnel

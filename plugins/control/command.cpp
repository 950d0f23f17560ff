#include "plugins/control/command.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <vector>

#include "core/base/nearest_name.h"
#include "core/base/number_text.h"
#include "plugins/command_service/request_table.h"

namespace runnel {

namespace {

struct CommandKind {
  std::string name;
  std::size_t least_arguments;
  std::size_t most_arguments;
  std::vector<std::string> options;
  CommandMaker* make;
  enum class Needs { kNothing, kPace, kScheduler } needs = Needs::kNothing;
};
using Needs = CommandKind::Needs;

constexpr std::size_t kMostPatterns = 1000;
// Options that are either there, as "yes", or not.
constexpr std::array kFlags{"long", "full", "follow", "yes", "config", "overwrite", "once", "all", "abort"};

const std::vector<CommandKind>& Kinds() {
  static const std::vector<CommandKind> kinds{
      {"ls", 0, 1, {"long"}, MakeListCommand},
      {"paths", 0, 0, {}, MakePathsCommand},
      {"types", 0, 0, {}, MakeTypesCommand},
      {"get", 1, 1, {"full"}, MakeGetCommand},
      {"echo", 1, 1, {"count", "full"}, MakeEchoCommand},
      {"hz", 1, 1, {"count"}, MakeRateCommand},
      {"log", 0, 0, {"follow", "level"}, MakeLogCommand},
      {"change", 0, 0, {"file", "yes"}, MakeServiceCommand},
      {"undo", 0, 0, {}, MakeServiceCommand},
      {"redo", 0, 0, {}, MakeServiceCommand},
      {"save", 0, 1, {"config", "overwrite"}, MakeServiceCommand},
      {"pause", 0, 1, {}, MakePauseCommand, Needs::kPace},
      {"resume", 0, 1, {}, MakeResumeCommand, Needs::kPace},
      {"step", 0, 1, {}, MakeStepCommand, Needs::kPace},
      {"speed", 0, 1, {}, MakeSpeedCommand, Needs::kPace},
      {"top", 0, 0, {"once", "count"}, MakeTopCommand, Needs::kScheduler},
      {"profile", 0, 1, {}, MakeProfileCommand, Needs::kScheduler},
      {"latency", 0, 3, {}, MakeLatencyCommand, Needs::kScheduler},
      {"deadline", 0, 2, {}, MakeDeadlineCommand, Needs::kScheduler},
      {"reload", 1, 1, {}, MakeServiceCommand},
      {"restart", 0, 1, {}, MakeServiceCommand},
      {"stop", 0, 0, {}, MakeServiceCommand},
      {"release", 0, 1, {}, MakeServiceCommand},
      {"block", 1, 1, {}, MakeServiceCommand},
      {"quit", 0, 0, {}, MakeServiceCommand},
      {"publish", 2, 2, {"rate", "deadline"}, MakeServiceCommand},
      {"call", 1, 2, {"timeout"}, MakeCallCommand},
      {"network", 0, 0, {}, MakeNetworkCommand},
      {"activities", 0, 1, {"all", "abort"}, MakeActivitiesCommand},
      {"record", 0, kMostPatterns, {"file", "count", "compression"}, MakeRecordCommand},
  };
  return kinds;
}

Result<void> CheckArguments(const Request& request, const CommandKind& kind) {
  // In this version, what clients of before ask for.
  if (kind.name == "stop" && !request.arguments.empty()) {
    return Error{.message = "'stop' has no path any more: it is the STOP of the robot",
                 .hint = "'pause PATH' leaves modules out of cycles, 'block PORT' stops one port"};
  }
  if (kind.name == "publish" && request.Has("stop")) {
    return Error{.message = "'publish PORT stop=yes' is called otherwise now", .hint = "'block PORT'"};
  }
  if (request.arguments.size() < kind.least_arguments) {
    const bool lacks_value = kind.least_arguments > 1 && !request.arguments.empty();
    return Error{.message = "'" + kind.name + "' wants " + (lacks_value ? "a value" : "a path")};
  }
  if (request.arguments.size() > kind.most_arguments) {
    return Error{.message =
                     "'" + request.arguments[kind.most_arguments] + "' is one word too many for '" + kind.name + "'"};
  }
  // Only values may be empty texts.
  const std::size_t words = kind.name == "publish" || kind.name == "call" ? 1 : request.arguments.size();
  for (std::size_t i = 0; i < std::min(words, request.arguments.size()); ++i) {
    if (request.arguments[i].empty()) return Error{.message = "'" + kind.name + "': one of its words is empty"};
  }
  for (const auto& [name, value] : request.options) {
    if (std::ranges::count(kind.options, name) == 0) {
      return Error{.message = "'" + kind.name + "' has no option '" + name + "'",
                   .hint = NearestNameHint(name, kind.options)};
    }
    if (value != "yes" && std::ranges::find(kFlags, name) != kFlags.end()) {
      return Error{.message = "'" + kind.name + "': " + name + " is 'yes' or left out, not '" + value + "'"};
    }
  }
  if (!request.body.empty() && kind.name != "change") return Error{.message = "'" + kind.name + "' is one line only"};
  return {};
}

}  // namespace

CommandResult MakeCommand(const std::string& text, CommandService& service, TaskGroup& tasks,
                          std::optional<Time> asked) {
  const auto request = Request::Parse(text);
  if (!request) return request.error();
  const auto kind = std::ranges::find(Kinds(), request->command, &CommandKind::name);
  if (kind == Kinds().end()) {
    return Error{.message = "there is no command '" + request->command + "'",
                 .hint = NearestNameHint(request->command, NamesOf(Kinds(), &CommandKind::name))};
  }
  if (auto good = CheckArguments(*request, *kind); !good) return good.error();
  const ServedApplication& application = service.application();
  if ((kind->needs == Needs::kPace && application.pace == nullptr) ||
      (kind->needs == Needs::kScheduler && application.scheduler == nullptr)) {
    return Error{.message = kind->needs == Needs::kPace
                                ? "the program that runs this application cannot pause it or change its speed"
                                : "the program that runs this application does not say how it does so"};
  }
  // The service looks by itself, and knows what a change is of.
  if (kind->make != MakeServiceCommand && LetsMove(kind->name)) {
    const auto known = application.runtime.robot_stop().CheckIsKnown({.asked = asked, .requests = {}});
    if (!known) return known.error();
  }
  return kind->make(*request, {application, service, tasks, asked});
}

std::optional<ControlCode> Command::Continue(Answer& answer) {
  const CommandStep next = step_(answer);
  if (const auto* const code = std::get_if<ControlCode>(&next)) return *code;
  const auto* const task = std::get_if<std::shared_ptr<const WorkerTask>>(&next);
  task_ = task != nullptr ? *task : nullptr;
  if (task_ == nullptr) due_ = std::chrono::steady_clock::now() + std::get<Duration>(next);
  return {};
}

Command::Step UnderLock(Runtime& runtime, Command::Step work) {
  return [&runtime, work = std::move(work)](Answer& answer) -> CommandStep {
    const std::unique_lock lock(runtime.structure_mutex(), std::try_to_lock);
    if (!lock) return kLookAgain;
    return work(answer);
  };
}

ControlCode Say(Answer& answer, std::string_view text) {
  answer.Write(text);
  return ControlCode::kDone;
}

ControlCode Fail(Answer& answer, const Error& error) {
  answer.WriteError(ErrorLine(error));
  return ControlCode::kFailed;
}

ControlCode Refuse(Answer& answer, const Error& error) {
  answer.WriteError(ErrorLine(error));
  return ControlCode::kBadInput;
}

std::string ErrorLine(const Error& error) {
  Diagnostics diagnostics;
  diagnostics.Add(error);
  return diagnostics.ToString();
}

Result<std::optional<std::uint64_t>> ReadCountOption(const Request& request) {
  if (!request.Has("count")) return std::optional<std::uint64_t>();
  const std::string text = request.Option("count");
  const auto count = NumberIn<std::uint64_t>(text);
  if (count && *count >= 1 && *count <= 1'000'000'000) return count;
  return Error{.message = "'" + text + "' is not a count from 1 to 1000000000"};
}

}  // namespace runnel

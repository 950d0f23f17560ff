#include "plugins/control/command.h"

#include <algorithm>
#include <iterator>
#include <mutex>
#include <vector>

#include "core/base/nearest_name.h"
#include "core/base/number_text.h"
#include "plugins/command_service/request_table.h"

namespace runnel {

namespace {

enum class Needs { kNothing, kPace, kScheduler };

// Who makes a command that the service does not carry out; what words and options it has, its form says.
struct CommandKind {
  std::string_view name;
  CommandMaker* make = MakeServiceCommand;
  Needs needs = Needs::kNothing;
};
// clang-format off
constexpr CommandKind kKinds[] = {
    {"ls", MakeListCommand}, {"paths", MakePathsCommand}, {"types", MakeTypesCommand}, {"get", MakeGetCommand},
    {"echo", MakeEchoCommand}, {"hz", MakeRateCommand}, {"log", MakeLogCommand}, {"call", MakeCallCommand},
    {"network", MakeNetworkCommand}, {"activities", MakeActivitiesCommand}, {"record", MakeRecordCommand},
    {"pause", MakePauseCommand, Needs::kPace}, {"resume", MakeResumeCommand, Needs::kPace},
    {"step", MakeStepCommand, Needs::kPace}, {"speed", MakeSpeedCommand, Needs::kPace},
    {"top", MakeTopCommand, Needs::kScheduler}, {"profile", MakeProfileCommand, Needs::kScheduler},
    {"latency", MakeLatencyCommand, Needs::kScheduler}, {"deadline", MakeDeadlineCommand, Needs::kScheduler}};
// clang-format on

CommandKind KindOf(const std::string& command) {
  const auto* const found = std::ranges::find(kKinds, command, &CommandKind::name);
  return found != std::end(kKinds) ? *found : CommandKind{command};
}

// In this version, what clients of before ask for.
Result<void> RefuseFormerWords(const Request& request) {
  if (request.command == "stop" && !request.arguments.empty()) {
    return Error{.message = "'stop' has no path any more: it is the STOP of the robot",
                 .hint = "'pause PATH' leaves modules out of cycles, 'block PORT' stops one port"};
  }
  if (request.command == "publish" && request.Has("stop")) {
    return Error{.message = "'publish PORT stop=yes' is called otherwise now", .hint = "'block PORT'"};
  }
  return {};
}

Result<void> CheckWords(const Request& request, const std::vector<FieldForm>& fields) {
  const std::vector<std::string>& words = request.arguments;
  std::size_t least = 0, most = 0;
  for (const FieldForm& each : fields) {
    least += each.place == FieldForm::Place::kWord ? 1 : 0;
    if (!each.is_option()) most += each.kind == FieldForm::Kind::kTexts ? each.most : 1;
  }
  if (words.size() < least) {
    const bool lacks_value = least > 1 && !words.empty();
    return Error{.message = "'" + request.command + "' wants " + (lacks_value ? "a value" : "a path")};
  }
  if (words.size() > most) {
    return Error{.message = "'" + words[most] + "' is one word too many for '" + request.command + "'"};
  }
  // Only values may be empty texts.
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool is_value = i > 0 && fields[std::min(i, fields.size() - 1)].shown == "VALUE";
    if (words[i].empty() && !is_value) return Error{.message = "'" + request.command + "': one of its words is empty"};
  }
  return {};
}

Result<void> CheckOptions(const Request& request, std::vector<FieldForm> options) {
  std::erase_if(options, [](const FieldForm& each) { return !each.is_option(); });
  for (const auto& [name, value] : request.options) {
    const auto option = std::ranges::find(options, name, &FieldForm::name);
    if (option == options.end()) {
      return Error{.message = "'" + request.command + "' has no option '" + name + "'",
                   .hint = NearestNameHint(name, NamesOf(options, &FieldForm::name))};
    }
    if (value != "yes" && option->kind == FieldForm::Kind::kFlag) {
      return Error{.message = "'" + request.command + "': " + name + " is 'yes' or left out, not '" + value + "'"};
    }
  }
  return {};
}

Result<void> CheckRequest(const Request& request, const CommandForm& form) {
  if (auto good = RefuseFormerWords(request); !good) return good;
  std::vector<FieldForm> fields = form.fields;
  const bool has_body = form.name == "change";  // its file has been read by the client
  if (has_body) fields.front().place = FieldForm::Place::kOption;
  if (auto good = CheckWords(request, fields); !good) return good;
  if (auto good = CheckOptions(request, fields); !good) return good;
  if (!request.body.empty() && !has_body) return Error{.message = "'" + form.name + "' is one line only"};
  return {};
}

}  // namespace

CommandResult MakeCommand(const std::string& text, CommandService& service, TaskGroup& tasks,
                          std::optional<Time> asked) {
  const auto request = Request::Parse(text);
  if (!request) return request.error();
  const auto form = std::ranges::find(CommandForms(), request->command, &CommandForm::name);
  if (form == CommandForms().end()) {
    return Error{.message = "there is no command '" + request->command + "'",
                 .hint = NearestNameHint(request->command, NamesOf(CommandForms(), &CommandForm::name))};
  }
  if (auto good = CheckRequest(*request, *form); !good) return good.error();
  const CommandKind kind = KindOf(form->name);
  const ServedApplication& application = service.application();
  if ((kind.needs == Needs::kPace && application.pace == nullptr) ||
      (kind.needs == Needs::kScheduler && application.scheduler == nullptr)) {
    return Error{.message = kind.needs == Needs::kPace
                                ? "the program that runs this application cannot pause it or change its speed"
                                : "the program that runs this application does not say how it does so"};
  }
  // The service looks by itself, and knows what a change is of.
  if (kind.make != MakeServiceCommand && LetsMove(form->name)) {
    const auto known = application.runtime.robot_stop().CheckIsKnown({.asked = asked, .requests = {}});
    if (!known) return known.error();
  }
  return kind.make(*request, {application, service, tasks, asked});
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

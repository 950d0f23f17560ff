#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "plugins/command_service/command_service.h"
#include "plugins/control/protocol.h"

namespace runnel {

/// How a command ended: the exit codes of the program.
enum class ControlCode : int {
  kDone = 0,
  kFailed = 1,    ///< it could have worked, and has not
  kBadInput = 2,  ///< what was asked for cannot be done; nothing has been
};

/// Where the answer to a request goes.
class Answer {
 public:
  virtual void Write(std::string_view text) = 0;       ///< for standard output
  virtual void WriteError(std::string_view text) = 0;  ///< for standard errors
  /// The client asks for nothing more: what goes on until it has enough ends.
  [[nodiscard]] virtual bool has_enough() const { return false; }

 protected:
  ~Answer() = default;
};

/// What comes next: the command has ended; it wants to go on after a while, but not before what it has written is
/// on its way; or when a task is done, of which the task group tells.
using CommandStep = std::variant<ControlCode, Duration, std::shared_ptr<const WorkerTask>>;

/// One request while it is being answered.
///
/// Threads:  the server's. Steps do not wait for anything.
class Command {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;
  using Step = std::function<CommandStep(Answer& answer)>;

  explicit Command(Step step) : step_(std::move(step)) {}
  /// Does what can be done now. How it ended; nothing: call it again when due() has come.
  std::optional<ControlCode> Continue(Answer& answer);
  /// The past if it waits for a task that is done by now.
  [[nodiscard]] SteadyTime due() const noexcept {
    if (task_ == nullptr) return due_;
    return task_->is_done() ? SteadyTime::min() : SteadyTime::max();
  }

  [[nodiscard]] bool waits_for_task() const noexcept { return task_ != nullptr; }

 private:
  Step step_;
  SteadyTime due_{};
  std::shared_ptr<const WorkerTask> task_;
};

/// The command that the request names. `asked`: when, on the machine's steady clock, if the client says so: what would move
/// something is refused if STOP was pressed since. Errors: there is no such command, or its words are wrong.
[[nodiscard]] Result<Command> MakeCommand(const std::string& request, CommandService& service, TaskGroup& tasks,
                                          std::optional<Time> asked = {});

/// What a request is carried out on, and by.
struct CommandContext {
  const ServedApplication& application;
  CommandService& service;
  TaskGroup& tasks;
  std::optional<Time> asked;
};
using CommandResult = Result<Command>;
using CommandMaker = CommandResult(const Request& request, const CommandContext& context);
CommandMaker MakeGetCommand, MakeListCommand, MakePathsCommand, MakeTypesCommand, MakeEchoCommand, MakeRateCommand,
    MakeLogCommand, MakePauseCommand, MakeResumeCommand, MakeStepCommand, MakeSpeedCommand, MakeRecordCommand,
    MakeDeadlineCommand, MakeTopCommand, MakeProfileCommand, MakeLatencyCommand, MakeCallCommand, MakeActivitiesCommand,
    MakeNetworkCommand;
/// What an extension shows under a name (plugins/command_service/extension_texts.h).
[[nodiscard]] Command ShowExtensionText(Runtime& runtime, const std::string& name, const std::string& argument,
                                        Duration patience = std::chrono::seconds(3));
/// Of those that the service carries out.
CommandMaker MakeServiceCommand;

/// The errors and warnings as lines, the first hundred of each.
[[nodiscard]] std::string DiagnosticsText(const Diagnostics& all);
/// "path: error: message; hint" with an end of line.
[[nodiscard]] std::string ErrorLine(const Error& error);

/// Says it, and is done.
ControlCode Say(Answer& answer, std::string_view text);
/// Values in text format with their numbers as people read them: six significant digits. Whole numbers, and what stands in
/// quotation marks, stay as they are.
[[nodiscard]] std::string ReadableNumbers(std::string_view text);
/// Complains of the error: what was wanted could have worked, and has not; or it is the client's.
ControlCode Fail(Answer& answer, const Error& error);
ControlCode Refuse(Answer& answer, const Error& error);

/// How often a command that finds the structure locked, or has to look again and again, does so.
inline constexpr Duration kLookAgain = std::chrono::milliseconds(5);

/// `work` under the structure lock, once nobody else has it.
[[nodiscard]] Command::Step UnderLock(Runtime& runtime, Command::Step work);

/// How many lines or values a client wants: the option "count". Errors: no number from 1 to 1e9.
[[nodiscard]] Result<std::optional<std::uint64_t>> ReadCountOption(const Request& request);

}  // namespace runnel

#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/element/runtime.h"
#include "core/plugin/module_registry.h"
#include "plugins/control/change_worker.h"
#include "plugins/control/control_log.h"
#include "plugins/control/recording_hook.h"
#include "plugins/control/request.h"
#include "plugins/structure/structure_editor.h"

namespace runnel {

class ChangeHistory;
class Pace;

/// What a program may give to clients besides looking at the structure and changing it.
struct ControlHooks {
  /// Loads a plugin, under the structure lock: change sets may name types of plugins that are not
  /// loaded yet. Optional.
  std::function<Result<void>(const std::string& plugin)> load_plugin = {};
  /// Saves the structure into the file ("": the one that it came from) and says what was done.
  /// Optional. Called by a thread of the server.
  std::function<Result<std::string>(const std::string& file)> save = {};
  /// Loads a plugin anew, makes its modules anew, and says what was done. Optional. Called by a thread of
  /// the server.
  std::function<Result<std::string>(const std::string& plugin)> reload = {};
  /// Records ports until the client goes. Optional. Called by a thread of the server.
  RecordingHook record = {};
};

/// What commands work on. All of it outlives the server.
struct ControlledApplication {
  Runtime& runtime;
  const ModuleRegistry& modules;
  StructureEditor& editor;
  ControlLog& log;
  ControlHooks hooks = {};
  /// Changes go through it, so that they can be undone. Optional.
  ChangeHistory* history = nullptr;
  /// Of the scheduler that runs the application. Optional.
  Pace* pace = nullptr;
};

/// How a command ended: the exit codes of the program.
enum class ControlCode : int {
  kDone = 0,
  kFailed = 1,    ///< it could have worked, and has not
  kBadInput = 2,  ///< what was asked for cannot be done; nothing has been
};

/// Where the answer to a request goes.
class Answer {
 public:
  virtual void Write(std::string_view text) = 0;     ///< for standard output
  virtual void Complain(std::string_view text) = 0;  ///< for standard errors

 protected:
  ~Answer() = default;
};

/// One request while it is being answered.
///
/// Threads:  the server's. Continue() does not wait for anything.
class Command {
 public:
  using MachineTime = std::chrono::steady_clock::time_point;

  virtual ~Command() = default;
  /// Does what can be done now. How it ended; nothing: call it again when due() has come, or the
  /// worker has done something, and what it has written is on its way.
  virtual std::optional<ControlCode> Continue(Answer& answer) = 0;
  [[nodiscard]] MachineTime due() const noexcept { return due_; }

 protected:
  void ContinueIn(Duration duration) { due_ = std::chrono::steady_clock::now() + duration; }

 private:
  MachineTime due_{};
};

/// The command that the request names. Errors: there is none, or its words are wrong.
[[nodiscard]] Result<std::unique_ptr<Command>> MakeCommand(const std::string& request,
                                                           const ControlledApplication& application,
                                                           ChangeWorker& worker);

// Their makers.
using CommandResult = Result<std::unique_ptr<Command>>;
[[nodiscard]] CommandResult MakeListCommand(const Request&, const ControlledApplication&);
[[nodiscard]] CommandResult MakePathsCommand(const Request&, const ControlledApplication&);
[[nodiscard]] CommandResult MakeTypesCommand(const Request&, const ControlledApplication&);
[[nodiscard]] CommandResult MakeEchoCommand(const Request&, const ControlledApplication&);
[[nodiscard]] CommandResult MakeRateCommand(const Request&, const ControlledApplication&);
[[nodiscard]] CommandResult MakeLogCommand(const Request&, const ControlledApplication&);
[[nodiscard]] CommandResult MakeChangeCommand(const Request&, const ControlledApplication&,
                                              ChangeWorker&);
[[nodiscard]] CommandResult MakeSaveCommand(const Request&, const ControlledApplication&,
                                            ChangeWorker&);
[[nodiscard]] CommandResult MakeReloadCommand(const Request&, const ControlledApplication&,
                                              ChangeWorker&);
[[nodiscard]] CommandResult MakeUndoCommand(const Request&, const ControlledApplication&,
                                            ChangeWorker&);
[[nodiscard]] CommandResult MakeRedoCommand(const Request&, const ControlledApplication&,
                                            ChangeWorker&);
[[nodiscard]] CommandResult MakeRecordCommand(const Request&, const ControlledApplication&,
                                              ChangeWorker&);
[[nodiscard]] CommandResult MakePauseCommand(const Request&, const ControlledApplication&);
[[nodiscard]] CommandResult MakeResumeCommand(const Request&, const ControlledApplication&);
[[nodiscard]] CommandResult MakeStepCommand(const Request&, const ControlledApplication&);
[[nodiscard]] CommandResult MakeSpeedCommand(const Request&, const ControlledApplication&);

/// "path: error: message; hint" with an end of line.
[[nodiscard]] std::string ErrorLine(const Error& error);

/// How often a command that finds the structure locked, or has to look again and again, does so.
inline constexpr Duration kLookAgain = std::chrono::milliseconds(5);

/// How many lines or values a client wants: the option "count". Errors: no number from 1 to 1e9.
[[nodiscard]] Result<std::optional<std::uint64_t>> ReadCountOption(const Request& request);

}  // namespace runnel

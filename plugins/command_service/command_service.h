#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/clock.h"
#include "core/base/lookout.h"
#include "core/element/robot_stop.h"
#include "core/element/runtime.h"
#include "core/plugin/module_registry.h"
#include "plugins/command_service/application_log.h"
#include "plugins/command_service/command_request.h"
#include "plugins/command_service/command_worker.h"
#include "plugins/command_service/hand_settings.h"
#include "plugins/structure/structure_editor.h"

namespace runnel {

/// Presses the STOP of the robot when no operator has been heard for a stated time, as <operators> wants it. An operator is
/// a client who may drive: a page, a terminal, Python. The time is counted from Begin() on. A release that none of them has
/// asked for is followed by the next press at once.
///
/// Threads: any; one of its own presses, which takes neither the structure lock nor the worker.
class OperatorWatch {
 public:
  /// `watched_clock`: for tests, of a machine on which only Look() presses.
  explicit OperatorWatch(RobotStop& stop, const Clock* watched_clock = nullptr)
      : stop_(stop), watched_clock_(watched_clock), lookout_([this] { return Look(); }) {}

  /// Once.
  void Begin(Duration timeout);
  /// An operator, as people call him, has said something, and not before `at` on the machine's clock. What comes late may have
  /// been sent long ago, so the time of its arrival does not count; a time that is not over yet does not, either.
  void Hear(std::string_view name, Time at);
  /// Presses when it is time. When to look again; nothing: when STOP has been pressed or released.
  std::optional<Time> Look();
  /// 0: nobody has to be heard.
  [[nodiscard]] Duration timeout() const noexcept { return Duration(timeout_.load(std::memory_order_relaxed)); }

 private:
  [[nodiscard]] Time Now() const { return watched_clock_ != nullptr ? watched_clock_->Now() : SteadyClock().Now(); }

  RobotStop& stop_;
  const Clock* const watched_clock_;
  std::atomic<Duration::rep> timeout_{0};
  std::mutex mutex_;  // a leaf
  Time heard_{};      // guarded by mutex_
  std::string last_;  // so: who was heard then; "": nobody yet
  Lookout lookout_;
  StopSignal::Subscription changes_;  // first to go: it asks the lookout
};

class ChangeHistory;
class Pace;
class Scheduler;

/// What a client wants to be recorded.
struct RecordingRequest {
  std::string file;  ///< absolute
  std::vector<std::string> ports = {};
  std::string compression = {};
};

/// A recording that a client has begun. Ends with this. Threads: one at a time.
class ClientRecording {
 public:
  virtual ~ClientRecording() = default;
  /// How it is going, in one line.
  [[nodiscard]] virtual std::string Progress() = 0;
  /// Why nothing more is recorded, if so.
  [[nodiscard]] virtual std::optional<Error> Failure() = 0;
  /// Ends it, and says in one line what there is. May take a while.
  virtual Result<std::string> Finish() = 0;
};

/// Begins one. May take a while. Errors: of the file, of the ports; nothing is recorded then.
using RecordingHook = std::function<Result<std::unique_ptr<ClientRecording>>(const RecordingRequest&)>;

/// What a program may give to clients besides looking at the structure and changing it. All optional;
/// called by the worker.
struct ServiceHooks {
  /// Loads the plugins of the types in it that are not known yet. What cannot be loaded is told by who then misses the type.
  std::function<void(const ChangeSet& changes)> load_plugins = {};
  /// Saves the structure into the file ("": the one that it came from) and says what was done.
  std::function<Result<std::string>(const std::string& file)> save = {};
  /// What saving would make of the file, of which nothing is written.
  struct SaveDifference {
    std::string file;
    std::string before;
    std::string after;
  };
  std::function<Result<SaveDifference>(const std::string& file)> preview_save = {};
  /// Writes values of parameters back to the configuration, or all of them into the file, and says what was done.
  std::function<Result<std::string>(const std::string& file)> save_configuration = {};
  /// What would be lost by saving like that; nothing if the file is the application's own, or not there.
  std::function<std::optional<Error>(const SaveRequest& request)> find_overwritten = {};
  /// Loads a plugin anew, makes its modules anew, and says what was done.
  std::function<Result<std::string>(const std::string& plugin)> reload = {};
  /// The library of a plugin that is loaded; "" if that is unknown.
  std::function<std::string(const std::string& plugin)> library_of = {};
  /// Pauses what is at or below the path, or lets it go on.
  std::function<Result<void>(const std::string& path, bool is_paused)> set_paused = {};
  /// Ends the run, or ends it and runs the application again from its file, and says so; both after the answer.
  std::function<Result<std::string>()> quit = {};
  std::function<Result<std::string>()> restart = {};
  /// Whether the next process of the application will find what has become of STOP. Waits a moment for that; any thread.
  std::function<bool()> is_stop_kept = {};
  /// Records ports until the client goes.
  RecordingHook record = {};
};

/// What requests work on. All of it outlives the service.
struct ServedApplication {
  Runtime& runtime;
  const ModuleRegistry& modules;
  StructureEditor& editor;
  ApplicationLog& log;
  ServiceHooks hooks = {};
  /// Changes go through it, so that they can be undone. Optional.
  ChangeHistory* history = nullptr;
  /// Of the scheduler that runs the application. Optional.
  Pace* pace = nullptr;
  Scheduler* scheduler = nullptr;  ///< the same's; optional
};

/// What the STOP of the robot holds, or would hold, and what of that it does not reach now.
struct StopReach {
  std::string drives;                                          ///< as FindWhatDrives() says it
  std::vector<std::pair<std::string, std::string>> unreached;  ///< ports, and why
  std::string at_rest = {};                                    ///< with the safe value of supervision, as `drives`
  Duration brake{};                                            ///< the longest of all ports (PortStop::brake())
};
/// Nothing while somebody else has the structure lock, which is waited for some ms at most. `scheduler`: that of the
/// application; optional, here and below.
[[nodiscard]] std::optional<StopReach> FindStopReach(Runtime& runtime, const Scheduler* scheduler);
/// Whether the STOP that is in force stops all that moves; else an error says what it leaves and why, for those who pressed it
/// without a CommandService. Nobody's lock is waited for.
[[nodiscard]] Result<void> CheckThatAllStops(Runtime& runtime, const Scheduler* scheduler);

/// A request while it is carried out. Destroyed before it has begun, it is not done.
///
/// Threads:  one; its task group outlives it.
class PendingCommand {
 public:
  PendingCommand() = default;
  ~PendingCommand() {
    if (task_) task_->Cancel();
  }
  PendingCommand(const PendingCommand&) = delete;
  PendingCommand& operator=(const PendingCommand&) = delete;

  [[nodiscard]] const std::shared_ptr<WorkerTask>& task() const noexcept { return task_; }
  [[nodiscard]] bool is_done() const noexcept { return task_->is_done(); }
  /// Precondition: is_done().
  [[nodiscard]] CommandAnswer Take();

 private:
  friend class CommandService;
  const std::shared_ptr<CommandAnswer> answer_ =
      std::make_shared<CommandAnswer>();  // the worker's until the task is done
  std::shared_ptr<WorkerTask> task_;
};

/// The one place that carries out what clients of a running application ask for, whatever they are
/// connected by: the control socket, the inspector and Foxglove are transports of it. One for an
/// application.
///
/// Ownership:  what is served outlives it, and it outlives its transports.
/// Threads:    any; has one of its own, the worker, which never takes part in a cycle.
/// Errors:     in the answers. Whatever a plugin throws becomes one.
class CommandService {
 public:
  explicit CommandService(ServedApplication application);

  [[nodiscard]] const ServedApplication& application() const noexcept { return application_; }
  /// For what else a transport has to do that may wait.
  [[nodiscard]] CommandWorker& worker() noexcept { return worker_; }
  /// What clients have set by hand. Any thread.
  [[nodiscard]] const HandSettings& hand_settings() const noexcept { return hand_settings_; }
  /// Of a client that drives no longer: see HandSettings. Any thread.
  void EndLease(const std::string& lease) { hand_settings_.EndLease(lease); }
  /// Transports tell it whom they hear. Any thread.
  [[nodiscard]] OperatorWatch& operators() noexcept { return operators_; }

  /// Carries it out behind what was asked for before. `on_done` is called by the worker when the answer is
  /// there; without it, that of the tasks. A RobotStopRequest is carried out, and `on_done` called, before this returns.
  /// `as_of`: when it was asked for, and what was known then; what is not said: now. What lets something move (LetsMove())
  /// is refused if STOP has been pressed or released since, until the moment at which it takes effect.
  [[nodiscard]] std::unique_ptr<PendingCommand> Begin(CommandRequest request, TaskGroup& tasks,
                                                      std::function<void()> on_done = {}, RobotStop::AsOf as_of = {});

 private:
  [[nodiscard]] CommandAnswer Do(const SaveRequest& request) const;
  [[nodiscard]] CommandAnswer Do(const PauseRequest& request) const;
  [[nodiscard]] CommandAnswer Do(const ReloadRequest& request) const;
  [[nodiscard]] CommandAnswer Do(const PublishRequest& request, const RobotStop::AsOf& as_of);
  [[nodiscard]] CommandAnswer Do(const ReleaseRequest& request, const RobotStop::AsOf& as_of);
  [[nodiscard]] CommandAnswer Do(const RestartRequest&) const {
    return End("restart", "run it again", application_.hooks.restart);
  }
  [[nodiscard]] CommandAnswer Do(const QuitRequest&) const {
    return End("quit", "end its run", application_.hooks.quit);
  }
  [[nodiscard]] CommandAnswer End(const char* name, const char* what,
                                  const std::function<Result<std::string>()>& end) const;
  [[nodiscard]] CommandAnswer Do(const BlockRequest& request);
  [[nodiscard]] CommandAnswer Do(const RobotStopRequest& request, const RobotStop::AsOf& as_of,
                                 bool has_pressed = false) const;
  [[nodiscard]] CommandAnswer Do(const UndoRequest&, const RobotStop::AsOf& as_of) const {
    return TakeHistoryStep(true, as_of);
  }
  [[nodiscard]] CommandAnswer Do(const RedoRequest&, const RobotStop::AsOf& as_of) const {
    return TakeHistoryStep(false, as_of);
  }
  [[nodiscard]] CommandAnswer TakeHistoryStep(bool goes_back, const RobotStop::AsOf& as_of) const;

  const ServedApplication application_;
  const std::unique_ptr<ElementListener> recorder_;  // of what others than clients change
  CommandWorker worker_;                             // its tasks use the rest
  HandSettings hand_settings_;                       // first to go: tasks of the worker
  const StopSignal::Subscription stop_;              // logs what becomes of the robot's STOP
  OperatorWatch operators_;
};

}  // namespace runnel

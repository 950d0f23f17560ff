#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "core/log/log_sink.h"
#include "plugins/application/application.h"
#include "plugins/application/application_description.h"
#include "plugins/application/application_extension.h"
#include "plugins/application/internal/stop_file.h"
#include "plugins/application/run_report.h"
#include "plugins/command_service/application_log.h"
#include "plugins/command_service/command_service.h"
#include "plugins/control/control_server.h"
#include "plugins/structure/change_history.h"
#include "plugins/supervision/supervisor.h"

namespace runnel {

/// What an application consists of besides its description: each may use what stands before it, so they are
/// destroyed from the last to the first.
struct Application::Parts final : ApplicationDescription {
  using ApplicationDescription::ApplicationDescription;
  ~Parts() override;

  std::vector<LogMessage> early_messages;  // what modules say while it is loaded; guarded by events_mutex

  bool is_composed = false;  // in code: whoever composes it makes it ready
  std::optional<Scheduler> scheduler;
  std::optional<StructureEditor> editor;
  // What people have changed; the supervisor's changes are not theirs.
  std::optional<ChangeHistory> history;
  std::optional<Supervisor> supervisor;
  std::optional<ApplicationLog> log;
  std::optional<RunReport> report;
  ServiceHooks hooks;  // of extensions
  std::optional<CommandService> service;
  std::mutex reloading;                 // one plugin after the other; before all others
  std::size_t prepared_extensions = 0;  // that must be ended
  std::unique_ptr<StopFile> stop_file;
  std::unique_ptr<ControlServer> control;

  Time start{};              // of the run, on the application's clock
  bool has_started = false;  // once, at least
  bool has_warned = false;   // of what the scheduler finds doubtful
  std::mutex attending;      // one at a time; before all others
  // What no look has found the memory to tell of yet; guarded by attending.
  std::vector<Fault> untold_faults;
  std::vector<Error> untold_failures;
  std::vector<Notice> untold_notices;
  std::mutex events_mutex;              // a leaf
  std::deque<ApplicationEvent> events;  // guarded by events_mutex
  std::atomic<std::uint64_t> ties{0};   // made so far

  // The thread of Start().
  std::mutex running_mutex;
  std::condition_variable has_changed;
  bool ends = false;  // guarded by running_mutex
  std::atomic<bool> is_running{false};
  std::thread thread;

  // From the first module on, until the last has gone.
  void Hear(const LogMessage& message);
  LogSink log_sink{runtime(), [this](const LogMessage& message) { Hear(message); }};

  // The steps of loading.
  Result<void> Schedule();
  Result<void> Begin(Application& application, Diagnostics& diagnostics);

  RecordingHook RecordingOnDemand(Application& application);
  [[nodiscard]] bool IsOwnFile(const std::filesystem::path& file);
  /// What the file has lost, and what passes with the run, for people.
  Result<std::string> Save(const std::filesystem::path& file);
  Result<void> LoadPlugin(std::string_view plugin);
  void LoadPluginOf(std::string_view type);
  void LoadPluginsOf(const ChangeSet& changes);

  // Asked now and then for how long it has run. True: it is over.
  using LookAround = std::function<bool(Duration so_far)>;
  // How long it has run on its clock; no cycle runs any more then. The thread of Start() is ended, if it is
  // that. The threads have been started.
  Duration RunThreads(std::optional<Duration> limit, const LookAround& look);
  // Cycles that are due at the limit do not run. Errors: there is nothing to run, and it does not wait for that.
  Result<Duration> RunCycles(std::optional<Duration> limit, bool waits_for_tasks, const LookAround& look);
  // Whether the thread of Start() is to end. Waits for it so long.
  bool EndsWithin(Duration longest);
  // Ends the thread of Start(), if there is one.
  void Join();
  void Add(ApplicationEvent event);
  // The element of the application, which somebody may have deleted. Under the structure lock.
  Result<FrameworkElement*> FindAgain();
  // As an error of this application: with path and place.
  [[nodiscard]] Error Placed(Error error) const;
};

}  // namespace runnel

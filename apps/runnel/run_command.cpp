#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include "apps/runnel/command_line.h"
#include "apps/runnel/end_watch.h"
#include "apps/runnel/other_programs.h"
#include "apps/runnel/output.h"
#include "apps/runnel/progress_display.h"
#include "core/log/log_sink.h"
#include "core/plugin/plugin_manager.h"
#include "plugins/application/application.h"
#include "plugins/application/application_description.h"
#include "plugins/application/extension_description.h"
#include "plugins/application/run_report.h"
#include "plugins/command_service/application_log.h"
#include "plugins/crash_report/crash_report.h"

namespace runnel::program {

namespace {

using ClockKind = SchedulerOptions::ClockKind;

constexpr auto kLookForSignal = std::chrono::milliseconds(50);

void PrintTimes(Duration so_far, std::chrono::steady_clock::duration real, ClockKind clock) {
  const double seconds = ToSeconds(so_far);
  const double real_seconds = ToSeconds(Duration(real));
  if (clock == ClockKind::kReal) {
    std::cout << fmt::format("ran for {:.2f} s\n", seconds);
  } else {
    std::cout << fmt::format("simulated {:.2f} s in {:.2f} s: {} times real time\n", seconds, real_seconds,
                             NumberText(seconds / real_seconds));
  }
}

// A text file into which what happens to an application is written as it happens: `runnel run --log FILE`.
class LogFile {
 public:
  // What was in the file before goes. Errors: Failure().
  explicit LogFile(std::string file) : file_(std::move(file)), stream_(file_) {}

  // What has come since the last call.
  void Append(const ApplicationLog& log) {
    while (next_ < log.end()) {
      const ApplicationLog::Entries read = log.ReadEntries(next_, ApplicationLog::kMostEntries);
      if (read.lost > 0) stream_ << "(" << read.lost << " entries came too fast)\n";
      for (const auto& entry : read.entries) stream_ << ApplicationLog::LineOf(entry) << '\n';
      stream_.flush();
      next_ = read.next;
    }
  }
  // Why not all of it is in the file.
  [[nodiscard]] std::optional<Error> Failure() const {
    if (stream_) return {};
    return Error{.message = "the log cannot be written", .position = {file_}};
  }

 private:
  std::string file_;
  std::ofstream stream_;
  std::uint64_t next_ = 0;
};

// One run of an application that has been loaded.
class Session {
 public:
  Session(const RunArguments& arguments, Application& application, EndWatch& watch)
      : arguments_(arguments),
        application_(application),
        watch_(watch),
        report_(application.report()),
        display_(!arguments.quiet) {
    if (!arguments.log_file.empty()) log_file_.emplace(arguments.log_file);
  }

  ~Session() { watch_.WaitFor("one of its connections or extensions"); }

  ExitCode Run() {
    watch_.BeginThreads(
        application_, [this] { PrintEvents(); }, [this] { FinishFiles(); });
    const auto failure = log_file_ ? log_file_->Failure() : std::nullopt;
    if (failure) return Fail(*failure, ExitCode::kBadInput);
    RunOptions options;
    if (arguments_.duration) options.limit = FromSeconds(*arguments_.duration);
    options.is_over = [this](Duration so_far) {
      LookAround(so_far);
      return false;
    };
    const auto real_start = std::chrono::steady_clock::now();
    const auto ran = [&] {
      const CrashReport report({.file = arguments_.crash_file.value_or(fmt::format("runnel_crash_{}.txt", getpid())),
                                .rescue = [this](const Crash& crash) { Rescue(crash); }});
      return application_.Run(options);
    }();
    const auto real = std::chrono::steady_clock::now() - real_start;
    PrintEvents();
    ClearProgress();
    if (!ran) return Fail(ran.error().WithPosition(arguments_.application.file), ExitCode::kBadInput);
    const bool was_asked = EndWatch::has_come() || watch_.is_asked();
    const ExitCode code = Conclude(*ran, real, was_asked);
    const auto is_held = [](const auto& extension) { return extension->IsHeld(); };
    if (!was_asked && std::ranges::any_of(application_.extensions(), is_held)) Hold();
    return code;
  }

 private:
  // What has come of the run can still be looked at.
  void Hold() const {
    std::cout << "held for viewers; Ctrl-C ends it, 'runnel restart' runs it again\n" << std::flush;
    while (!EndWatch::has_come() && !watch_.is_asked()) std::this_thread::sleep_for(kLookForSignal);
  }

  void LookAround(Duration so_far) {
    PrintEvents();
    Pace& pace = application_.scheduler().pace();
    const std::lock_guard lock(printing_);
    if (display_.IsDue()) display_.Show(so_far, pace.is_paused(), report_.Progress());
    if (arguments_.steps) LookForTypedSteps(pace);
  }

  // Lets a paused application run one cycle for each line of standard input, without waiting for one.
  void LookForTypedSteps(Pace& pace) {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (input_has_ended_ || poll(&input, 1, 0) <= 0) return;
    std::array<char, 256> typed;
    const ssize_t count = read(STDIN_FILENO, typed.data(), typed.size());
    input_has_ended_ = count <= 0;
    if (count <= 0) return;
    const auto lines = std::count(typed.data(), typed.data() + count, '\n');
    if (lines > 0) (void)pace.StepCycles(static_cast<std::uint64_t>(lines));
  }

  void ClearProgress() {
    const std::lock_guard lock(printing_);
    display_.Clear();
  }

  void PrintEvents() {
    const std::lock_guard lock(printing_);
    for (const ApplicationEvent& event : application_.TakeEvents()) {
      display_.Clear();
      std::cerr << Coloured(event.text, STDERR_FILENO) << std::flush;
    }
    AppendToLogFile();
  }

  void AppendToLogFile() {
    const std::lock_guard lock(log_file_mutex_);
    if (log_file_) log_file_->Append(application_.log());
  }

  // In a thread of its own, while this one may be the one that has crashed.
  void Rescue(const Crash& crash) {
    application_.log().Add(ApplicationLog::Kind::kFault,
                           (crash.module.empty() ? "the program" : crash.module) + " has crashed: " + crash.signal,
                           crash.module);
    FinishFiles();
  }

  // While anything may still use them.
  void FinishFiles() {
    FlushLog();
    AppendToLogFile();
    for (const auto& extension : application_.extensions()) extension->OnCrash();
  }

  // An extension does, if one of them says when it is over: of a replay.
  bool MonitorsDecide() {
    const auto decides = [](const auto& extension) { return extension->IsOver().has_value(); };
    return std::ranges::none_of(application_.extensions(), decides);
  }

  std::string WhyItEnded(bool has_failed, bool was_asked) {
    if (has_failed) return "the run was ended because of a fault\n";
    if (application_.is_deleted()) return "the application has been deleted\n";
    if (watch_.shall_restart() && !EndWatch::has_come()) return "the run ends, to begin again\n";
    if (was_asked) return "ended by the user\n";
    return report_.IsOver() || !MonitorsDecide() ? "" : "the time is up\n";
  }

  ExitCode Conclude(Duration so_far, std::chrono::steady_clock::duration real, bool was_asked) {
    const Scheduler& scheduler = application_.scheduler();
    const bool has_failed = scheduler.ended_by_fault();
    Diagnostics failures;
    std::string verdict = report_.Verdicts();
    std::cout << verdict << report_.Finish(failures);
    for (const auto& extension : application_.extensions()) {
      const std::string text = extension->Finish(failures);
      std::cout << text;
      verdict += text;
    }
    std::cout << std::flush;
    const std::string why = WhyItEnded(has_failed, was_asked);
    application_.NoteEnd(verdict + why);
    AppendToLogFile();
    if (auto failure = log_file_ ? log_file_->Failure() : std::nullopt) failures.Add(*failure);
    std::cerr << Coloured(failures.ToString(), STDERR_FILENO);
    (has_failed ? std::cerr : std::cout) << why;
    if (!arguments_.quiet) PrintTimes(so_far, real, scheduler.options().clock);
    if (arguments_.statistics) std::cout << StatisticsTable(application_.runtime().root());
    if (const auto measured = application_.scheduler().profiled_for()) {
      std::cout << ProfileText(application_.scheduler().ReadProfile(), *measured);
    }
    const bool is_well_judged = report_.IsGood() || !MonitorsDecide();
    return !has_failed && is_well_judged && failures.ok() ? ExitCode::kDone : ExitCode::kRunFailed;
  }

  const RunArguments& arguments_;
  Application& application_;
  EndWatch& watch_;
  RunReport& report_;
  ProgressDisplay display_;
  std::mutex printing_;  // before the next one
  std::mutex log_file_mutex_;
  std::optional<LogFile> log_file_;
  bool input_has_ended_ = false;
};

ApplicationOptions OptionsOf(const RunArguments& arguments) {
  ApplicationOptions options = arguments.application.Options();
  options.speed = arguments.speed;
  options.is_paused = arguments.is_paused;
  options.speed_words = "--fast and --speed";
  options.pause_words = "--paused";
  options.has_control = arguments.has_control;
  options.keeps_stop = true;
  options.clears_stop = arguments.clears_stop;
  options.notes_running_modules = true;
  options.is_profiled = arguments.is_profiled;
  // Time that is stepped from cycle to cycle is one thread's.
  if (arguments.is_single_threaded) {
    options.clock = ClockKind::kSimulated;
    options.speed = arguments.speed.value_or(1);
  }
  // Of what was recorded, replayed for viewers alone.
  if (arguments.application.file.empty()) options.clock = ClockKind::kSimulated;
  options.extensions_by_name = arguments.extensions;
  return options;
}

// What the file would be refused for, if it were loaded now.
Result<void> CheckFile(const RunArguments& arguments) {
  if (arguments.application.file.empty()) return {};
  ApplicationDescription description(arguments.application.Options());
  (void)description.Read(arguments.application.file);
  if (description.diagnostics().ok()) return {};
  return description.diagnostics().errors().front();
}

// What a run before has written stays.
RunArguments ArgumentsOfNextRun(RunArguments arguments) {
  arguments.clears_stop = false;  // of the run that was begun by a person
  if (!arguments.log_file.empty()) arguments.log_file = FileOfNextRun(arguments.log_file);
  const auto catalogue = ExtensionCatalogue::Read(PluginManager().search_path());
  for (ExtensionByName& extension : arguments.extensions) {
    const ExtensionDescription* const known = catalogue ? catalogue->Find(extension.name) : nullptr;
    for (auto& given : extension.arguments.values) {
      const auto is_output = [&](const ExtensionOption& each) { return each.name == given.first && each.is_output; };
      if (known != nullptr && std::ranges::any_of(known->options, is_output)) {
        given.second = FileOfNextRun(given.second);
      }
    }
  }
  return arguments;
}

struct RunOutcome {
  ExitCode code;
  bool shall_restart = false;
};

RunOutcome RunOnce(const RunArguments& arguments) {
  const auto watch = std::make_shared<EndWatch>([&arguments] { return CheckFile(arguments); });
  ApplicationOptions options = OptionsOf(arguments);
  options.extensions.push_back(watch);
  const LoadedApplication application = Application::Load(arguments.application.file, std::move(options));
  std::cerr << Coloured(application.diagnostics().ToString(), STDERR_FILENO);
  if (!application) return {ExitCode::kBadInput};
  for (const auto& extension : application->extensions()) std::cout << extension->StartText();
  std::cout << std::flush;
  Session session(arguments, *application, *watch);
  const ExitCode code = session.Run();
  watch->EndThreads();
  return {code, watch->shall_restart()};
}

}  // namespace

ExitCode Run(const RunArguments& arguments) {
  if (const auto preloaded = PreloadAll(arguments.preloads); !preloaded) return Fail(preloaded.error());
  RunOutcome outcome = RunOnce(arguments);
  // Who has sent a signal wants it to end, whoever wants it to begin again.
  while (outcome.shall_restart && !EndWatch::has_come()) outcome = RunOnce(ArgumentsOfNextRun(arguments));
  return outcome.code;
}

}  // namespace runnel::program

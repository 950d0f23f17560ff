#include "apps/runnel/run_command.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "apps/runnel/number_text.h"
#include "apps/runnel/outside_access.h"
#include "apps/runnel/print_error.h"
#include "apps/runnel/progress_display.h"
#include "apps/runnel/recorded_application.h"
#include "apps/runnel/recording.h"
#include "apps/runnel/replay.h"
#include "apps/runnel/run_report.h"
#include "apps/runnel/running.h"
#include "apps/runnel/statistics_table.h"
#include "apps/runnel/stop_signal.h"
#include "apps/runnel/trace_run.h"
#include "apps/runnel/workplace.h"
#include "plugins/runtime_construction/source_place.h"
#include "plugins/scheduling_tags/xml_scheduling_tags.h"
#include "plugins/structure/change_history.h"
#include "plugins/structure/structure_editor.h"
#include "plugins/supervision/xml_supervision_tags.h"

namespace runnel::program {

namespace {

using ClockKind = SchedulerOptions::ClockKind;

constexpr auto kLookForSignal = std::chrono::milliseconds(50);

// A recording that is replayed for viewers alone.
bool IsWithoutApplication(const RunArguments& arguments) {
  return arguments.replay && arguments.application.file.empty();
}

Result<SchedulerOptions> ChooseOptions(const RunArguments& arguments,
                                       const FrameworkElement& application) {
  SchedulerOptions options = SchedulerOptionsOf(application);
  if (IsWithoutApplication(arguments)) options.clock = ClockKind::kSimulated;
  const auto refuse = [&](const char* message, const std::string& words) {
    return Error{
        .message = message,
        .position = {.file = arguments.application.file},
        .hint = "leave out " + words + ", or add <clock type=\"simulated\"/> to the application"};
  };
  const bool is_real = options.clock == ClockKind::kReal;
  if (arguments.speed && is_real) {
    return refuse("the speed of real time cannot be chosen", "--fast and --speed");
  }
  if (arguments.is_paused && is_real) return refuse("real time cannot be paused", "--paused");
  if (arguments.replay && !is_real) options.speed = 1;
  if (arguments.speed) options.speed = *arguments.speed;
  if (arguments.is_paused) options.is_paused = true;
  return options;
}

Result<void> AddFaultRules(const FrameworkElement& application, Scheduler& scheduler) {
  for (const auto& [rule, position] : FaultRulesOf(application)) {
    if (auto added = scheduler.AddFaultRule(rule); !added) {
      Error error = added.error();
      error.position = position;
      return error;
    }
  }
  return {};
}

// What is done about faults and silence while the application runs.
struct Supervision {
  Supervision(Runtime& runtime, const ModuleRegistry& modules, Scheduler& scheduler)
      : editor(runtime, modules, &scheduler),
        supervisor(runtime, scheduler, [this](const ChangeSet& changes) -> Result<void> {
          const ChangeOutcome outcome = editor.Apply(changes);
          if (!outcome) return outcome.diagnostics.errors().front();
          return {};
        }) {}

  StructureEditor editor;
  ChangeHistory history{
      editor};  // what people have changed; the supervisor's changes are not theirs
  Supervisor supervisor;
};

void PrintWarnings(std::vector<Error> warnings, FrameworkElement& root, ControlLog& log) {
  const std::lock_guard lock(root.runtime().structure_mutex());
  Diagnostics diagnostics;
  for (Error& warning : warnings) {
    const auto element = root.Find(warning.path);
    if (element && warning.position.file.empty()) warning.position = FindSourcePlace(**element);
    diagnostics.AddWarning(std::move(warning));
  }
  std::cerr << diagnostics.ToString();
  for (const Error& warning : diagnostics.warnings()) {
    log.Add(ControlLog::Kind::kWarning, warning.ToString());
  }
}

void PrintTimes(Duration so_far, std::chrono::steady_clock::duration real, ClockKind clock) {
  char line[64];
  const double seconds = ToSeconds(so_far);
  const double real_seconds = ToSeconds(Duration(real));
  if (clock == ClockKind::kReal) {
    std::snprintf(line, sizeof line, "ran for %.2f s\n", seconds);
    std::cout << line;
  } else {
    std::snprintf(line, sizeof line, "simulated %.2f s in %.2f s: ", seconds, real_seconds);
    std::cout << line << NumberText(seconds / real_seconds) << " times real time\n";
  }
}

// One run of an application that has been built.
class Session {
 public:
  Session(const RunArguments& arguments, FrameworkElement& application, Scheduler& scheduler,
          Supervisor& supervisor, ControlLog& log, OutsideAccess& access, Recorder* recorder,
          Replay* replay)
      : arguments_(arguments),
        scheduler_(scheduler),
        supervisor_(supervisor),
        log_(log),
        access_(access),
        recorder_(recorder),
        replay_(replay),
        root_(application.runtime().root()),
        start_(application.runtime().clock().Now()),
        report_(application.runtime()),
        display_(!arguments.quiet) {}

  ExitCode Run(Runtime& runtime) {
    const StopSignal stop_signal(scheduler_);
    std::optional<Duration> limit;
    if (replay_ != nullptr) {
      limit = replay_->limit();
      replay_->Start();
    }
    if (arguments_.duration) {
      limit = std::min(limit.value_or(Duration::max()), FromSeconds(*arguments_.duration));
    }
    const auto real_start = std::chrono::steady_clock::now();
    const auto ran = program::Run(
        {scheduler_, runtime, limit, [this](Duration so_far) { return LookAround(so_far); }});
    const auto real = std::chrono::steady_clock::now() - real_start;
    PrintFaults();
    display_.Clear();
    if (!ran) {
      WarnOnce();
      Error error = ran.error();
      if (error.position.file.empty()) error.position.file = arguments_.application.file;
      PrintError(error);
      return ExitCode::kBadInput;
    }
    const bool was_asked = stop_signal.has_come();
    const ExitCode code = Conclude(*ran, real, was_asked);
    if (arguments_.inspect.hold && !was_asked) Hold(stop_signal);
    return code;
  }

 private:
  // What has come of the run can still be looked at.
  static void Hold(const StopSignal& stop_signal) {
    std::cout << "held for viewers; Ctrl-C ends it\n" << std::flush;
    while (!stop_signal.has_come()) std::this_thread::sleep_for(kLookForSignal);
  }

  bool LookAround(Duration so_far) {
    WarnOnce();
    PrintFaults();
    if (display_.IsDue()) {
      display_.Show(so_far, scheduler_.pace().is_paused(), report_.Progress());
    }
    return replay_ != nullptr ? replay_->LookAround() : report_.IsOver();
  }

  // Not before the start, which only shows what the system refuses to real-time threads.
  void WarnOnce() {
    if (!std::exchange(has_warned_, true)) PrintWarnings(scheduler_.Warnings(), root_, log_);
  }

  void PrintFaults() {
    for (const Fault& fault : scheduler_.TakeFaults()) {
      report_.Hear(fault);
      display_.Clear();
      const std::string text = FaultText(fault, start_, root_);
      std::cerr << text << std::flush;
      log_.Add(ControlLog::Kind::kFault, text);
      access_.Hear(fault);
    }
    if (recorder_ != nullptr) {
      if (const auto failure = recorder_->TakeFailure()) {
        display_.Clear();
        PrintError(*failure);
        log_.Add(ControlLog::Kind::kWarning, failure->ToString());
      }
    }
    for (const Notice& notice : supervisor_.TakeNotices()) {
      display_.Clear();
      const std::string text = NoticeText(notice, start_, root_);
      std::cerr << text << std::flush;
      log_.Add(ControlLog::Kind::kFault, text);
    }
  }

  std::string WhyItEnded(bool was_stopped, bool was_asked) {
    if (was_stopped) return "the run was stopped because of a fault\n";
    if (was_asked) return "stopped by the user\n";
    if (replay_ != nullptr) return replay_->Text();
    return report_.IsOver() ? "" : "the time is up\n";
  }

  ExitCode Conclude(Duration so_far, std::chrono::steady_clock::duration real, bool was_asked) {
    const bool was_stopped = scheduler_.stopped_by_fault();
    const std::string verdicts = report_.Verdicts();
    Diagnostics failures;
    std::cout << verdicts << report_.Finish(failures);
    std::cout << std::flush;
    const bool is_recorded = FinishRecording();
    if (replay_ != nullptr && replay_->failure()) failures.Add(*replay_->failure());
    const std::string why = WhyItEnded(was_stopped, was_asked);
    access_.NoteEnd(verdicts + why);
    std::cerr << failures.ToString();
    (was_stopped ? std::cerr : std::cout) << why;
    if (!arguments_.quiet) PrintTimes(so_far, real, scheduler_.options().clock);
    if (arguments_.statistics) std::cout << StatisticsTable(root_);
    // What monitors say of a replay, they say of another run.
    const bool is_well_judged = replay_ != nullptr || report_.IsGood();
    const bool is_good = !was_stopped && is_well_judged && failures.ok() && is_recorded;
    return is_good ? ExitCode::kDone : ExitCode::kRunFailed;
  }

  // Whether the user has the recording that was asked for.
  bool FinishRecording() {
    if (recorder_ == nullptr) return true;
    const auto finished = recorder_->Finish();
    if (const auto failure = recorder_->TakeFailure()) PrintError(*failure);
    std::cout << RecordingText(recorder_->file(), recorder_->status());
    return finished.has_value();
  }

  const RunArguments& arguments_;
  Scheduler& scheduler_;
  Supervisor& supervisor_;
  ControlLog& log_;
  OutsideAccess& access_;
  Recorder* const recorder_;  // nullptr: nothing is recorded
  Replay* const replay_;      // nullptr: nothing is replayed
  FrameworkElement& root_;
  const Time start_;
  RunReport report_;
  ProgressDisplay display_;
  bool has_warned_ = false;
};

// nullptr: it has been said what is wrong.
FrameworkElement* BuildWhatRuns(const RunArguments& arguments, Workplace& workplace,
                                const Workplace::BeforeReady& before_ready) {
  if (!IsWithoutApplication(arguments)) {
    return workplace.Build(arguments.application, BuildMode::kRun, before_ready).application;
  }
  const auto made = MakeRecordedApplication(arguments.replay->file, workplace, before_ready);
  if (made) return *made;
  PrintError(made.error());
  return nullptr;
}

}  // namespace

ExitCode Run(const RunArguments& arguments) {
  Workplace workplace;
  std::unique_ptr<TraceRecorder> trace;  // outlives the scheduler
  std::optional<Scheduler> scheduler;
  std::optional<Supervision> supervision;
  // Before modules become ready, so that they see the right clock from the start.
  const auto schedule = [&](FrameworkElement& application) -> Result<void> {
    auto options = ChooseOptions(arguments, application);
    if (!options) return options.error();
    auto started = StartTrace(arguments, application, *options);
    if (!started) return started.error();
    trace = std::move(*started);
    scheduler.emplace(workplace.runtime(), *options);
    supervision.emplace(workplace.runtime(), workplace.plugins().modules(), *scheduler);
    if (auto added = AddFaultRules(application, *scheduler); !added) return added;
    return AddSupervisionRules(application, supervision->supervisor);
  };
  FrameworkElement* const application = BuildWhatRuns(arguments, workplace, schedule);
  if (application == nullptr) return ExitCode::kBadInput;
  if (trace) trace->FollowStructure();
  std::unique_ptr<Replay> replay;
  if (arguments.replay) {
    auto prepared = Replay::Prepare(*arguments.replay, workplace.runtime(), *scheduler);
    if (!prepared) {
      PrintError(prepared.error());
      return ExitCode::kBadInput;
    }
    replay = std::move(*prepared);
  }
  ControlLog log(workplace.runtime().clock());
  auto access = OutsideAccess::Start(arguments, workplace, *application, *scheduler,
                                     supervision->editor, supervision->history, log);
  if (!access) {
    PrintError(access.error());
    return ExitCode::kBadInput;
  }
  const auto recorder =
      StartRecording(arguments.record, AboutApplication(arguments.application, application->name()),
                     workplace.runtime(), *scheduler);
  if (!recorder) {
    PrintError(recorder.error());
    return ExitCode::kBadInput;
  }
  const ExitCode code = Session(arguments, *application, *scheduler, supervision->supervisor, log,
                                **access, recorder->get(), replay.get())
                            .Run(workplace.runtime());
  return trace ? FinishTrace(*trace, arguments, code) : code;
}

}  // namespace runnel::program

#include "apps/runnel/run_command.h"

#include <chrono>
#include <iostream>
#include <string>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "apps/runnel/number_text.h"
#include "apps/runnel/print_error.h"
#include "apps/runnel/progress_display.h"
#include "apps/runnel/run_extensions.h"
#include "apps/runnel/statistics_table.h"
#include "apps/runnel/stop_signal.h"
#include "apps/runnel/trace_run.h"
#include "apps/runnel/typed_steps.h"
#include "plugins/application/application.h"
#include "plugins/application/run_report.h"
#include "plugins/recording/recorded_ports.h"
#include "plugins/recording/recording_text.h"

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
    std::cout << fmt::format("simulated {:.2f} s in {:.2f} s: {} times real time\n", seconds,
                             real_seconds, NumberText(seconds / real_seconds));
  }
}

// One run of an application that has been loaded.
class Session {
 public:
  Session(const RunArguments& arguments, Application& application, const RunExtensions& with)
      : arguments_(arguments),
        application_(application),
        with_(with),
        report_(application.report()),
        display_(!arguments.quiet) {}

  ExitCode Run() {
    const StopSignal stop_signal(application_.scheduler());
    RunOptions options;
    if (arguments_.duration) options.limit = FromSeconds(*arguments_.duration);
    options.is_over = [this](Duration so_far) {
      LookAround(so_far);
      return false;
    };
    const auto real_start = std::chrono::steady_clock::now();
    const auto ran = application_.Run(options);
    const auto real = std::chrono::steady_clock::now() - real_start;
    PrintEvents();
    display_.Clear();
    if (!ran) {
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

  void LookAround(Duration so_far) {
    PrintEvents();
    Pace& pace = application_.scheduler().pace();
    if (display_.IsDue()) display_.Show(so_far, pace.is_paused(), report_.Progress());
    if (arguments_.replay && arguments_.replay->steps) steps_.Look(pace);
  }

  void PrintEvents() {
    for (const ApplicationEvent& event : application_.TakeEvents()) {
      display_.Clear();
      std::cerr << event.text << std::flush;
    }
  }

  std::string WhyItEnded(bool was_stopped, bool was_asked) {
    if (was_stopped) return "the run was stopped because of a fault\n";
    if (was_asked) return "stopped by the user\n";
    if (with_.replay) return with_.replay->Text();
    return report_.IsOver() ? "" : "the time is up\n";
  }

  ExitCode Conclude(Duration so_far, std::chrono::steady_clock::duration real, bool was_asked) {
    const Scheduler& scheduler = application_.scheduler();
    const bool was_stopped = scheduler.stopped_by_fault();
    const std::string verdicts = report_.Verdicts();
    Diagnostics failures;
    std::cout << verdicts << report_.Finish(failures);
    std::cout << std::flush;
    const bool is_recorded = FinishRecording();
    if (with_.replay && with_.replay->failure()) failures.Add(*with_.replay->failure());
    const std::string why = WhyItEnded(was_stopped, was_asked);
    application_.NoteEnd(verdicts + why);
    std::cerr << failures.ToString();
    (was_stopped ? std::cerr : std::cout) << why;
    if (!arguments_.quiet) PrintTimes(so_far, real, scheduler.options().clock);
    if (arguments_.statistics) std::cout << StatisticsTable(application_.runtime().root());
    // What monitors say of a replay, they say of another run.
    const bool is_well_judged = with_.replay || report_.IsGood();
    const bool is_good = !was_stopped && is_well_judged && failures.ok() && is_recorded;
    return is_good ? ExitCode::kDone : ExitCode::kRunFailed;
  }

  // Whether the user has the recording that was asked for.
  bool FinishRecording() {
    Recorder* const recorder = with_.recording->recorder();
    if (recorder == nullptr) return true;
    const auto finished = recorder->Finish();
    if (const auto failure = recorder->TakeFailure()) PrintError(*failure);
    std::cout << RecordingText(recorder->file(), recorder->status());
    return finished.has_value();
  }

  const RunArguments& arguments_;
  Application& application_;
  const RunExtensions& with_;
  RunReport& report_;
  ProgressDisplay display_;
  TypedSteps steps_;
};

LoadedApplication LoadWhatRuns(const RunArguments& arguments, const RunExtensions& with) {
  ApplicationOptions options = with.Options(arguments);
  if (!IsWithoutApplication(arguments)) {
    return Application::Load(arguments.application.file, std::move(options));
  }
  return Application::LoadFrom(
      [&](const BuildTools& tools) { return BuildRecordedPorts(arguments.replay->file, tools); },
      std::move(options));
}

}  // namespace

ExitCode Run(const RunArguments& arguments) {
  const RunExtensions with(arguments);
  const LoadedApplication application = LoadWhatRuns(arguments, with);
  std::cerr << application.diagnostics().ToString();
  if (!application) return ExitCode::kBadInput;
  const std::string url = with.viewers->url();
  if (!url.empty()) std::cout << "inspector: " << url << '\n' << std::flush;
  const ExitCode code = Session(arguments, *application, with).Run();
  return with.trace ? FinishTrace(*with.trace, arguments, code) : code;
}

}  // namespace runnel::program

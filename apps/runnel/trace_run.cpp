#include "apps/runnel/trace_run.h"

#include <iostream>

#include "apps/runnel/print_error.h"
#include "core/base/diagnostics.h"

namespace runnel::program {

Result<std::unique_ptr<TraceRecorder>> StartTrace(const RunArguments& arguments,
                                                  FrameworkElement& application,
                                                  SchedulerOptions& options) {
  if (arguments.trace.empty()) return std::unique_ptr<TraceRecorder>();
  auto recorder = TraceRecorder::Start(
      application.runtime(),
      {.file = arguments.trace,
       .application = application.name(),
       .is_simulated = options.clock == SchedulerOptions::ClockKind::kSimulated});
  if (recorder) options.tracer = recorder->get();
  return recorder;
}

ExitCode FinishTrace(TraceRecorder& recorder, const RunArguments& arguments, ExitCode code) {
  const auto finished = recorder.Finish();
  if (!finished) {
    PrintError(finished.error());
    return code == ExitCode::kDone ? ExitCode::kRunFailed : code;
  }
  if (!arguments.quiet) {
    std::cout << "traced " << finished->events << " events to " << arguments.trace << std::endl;
  }
  const auto warn = [&](std::uint64_t events, const char* why) {
    if (events == 0) return;
    Diagnostics diagnostics;
    diagnostics.AddWarning({.message = std::to_string(events) + " events are not in it, as " + why,
                            .position = {.file = arguments.trace}});
    std::cerr << diagnostics.ToString();
  };
  warn(finished->lost, "they came faster than they could be written down");
  warn(finished->left_out, "it is as long as a trace may be");
  return code;
}

}  // namespace runnel::program

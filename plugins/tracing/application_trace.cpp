#include "plugins/tracing/application_trace.h"

#include <utility>

namespace runnel {

Result<void> ApplicationTrace::Prepare(FrameworkElement& application, SchedulerOptions& options) {
  auto recorder = TraceRecorder::Start(
      application.runtime(),
      {.file = file_,
       .application = application.name(),
       .is_simulated = options.clock == SchedulerOptions::ClockKind::kSimulated});
  if (!recorder) return recorder.error();
  recorder_ = std::move(*recorder);
  options.tracer = recorder_.get();
  return {};
}

Result<void> ApplicationTrace::Begin(Application& /*application*/, Diagnostics& /*diagnostics*/) {
  recorder_->FollowStructure();
  return {};
}

std::string ApplicationTrace::Finish(Diagnostics& problems) {
  const auto finished = recorder_->Finish();
  if (!finished) {
    problems.Add(finished.error());
    return {};
  }
  const auto warn = [&](std::uint64_t events, const char* why) {
    if (events == 0) return;
    problems.AddWarning({.message = std::to_string(events) + " events are not in it, as " + why,
                         .position = {file_}});
  };
  warn(finished->lost, "they came faster than they could be written down");
  warn(finished->left_out, "it is as long as a trace may be");
  return "traced " + std::to_string(finished->events) + " events to " + file_ + "\n";
}

}  // namespace runnel

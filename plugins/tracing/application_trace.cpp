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

}  // namespace runnel

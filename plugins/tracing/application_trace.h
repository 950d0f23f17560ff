#pragma once

#include <memory>
#include <string>

#include "plugins/application/application_extension.h"
#include "plugins/tracing/trace_recorder.h"

namespace runnel {

/// Writes into a file what the threads of an application do, from its first cycle on.
///
///     auto trace = std::make_shared<ApplicationTrace>("run.json");
///     auto application = Application::Load("robot.xml", {.extensions = {trace}});
///
/// Errors: of loading: the file cannot be made.
class ApplicationTrace final : public ApplicationExtension {
 public:
  explicit ApplicationTrace(std::string file) : file_(std::move(file)) {}

  [[nodiscard]] const std::string& file() const noexcept { return file_; }
  /// Ends the trace, when no cycle runs any more. Errors: what could not be written.
  Result<TraceSummary> Finish() { return recorder_->Finish(); }

  Result<void> Prepare(FrameworkElement& application, SchedulerOptions& options) override;
  Result<void> Begin(Application& application, Diagnostics& diagnostics) override;
  void Release() noexcept override { recorder_.reset(); }

 private:
  const std::string file_;
  std::unique_ptr<TraceRecorder> recorder_;
};

}  // namespace runnel

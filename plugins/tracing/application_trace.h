#pragma once

#include <memory>
#include <string>

#include "plugins/application/application_extension.h"
#include "plugins/tracing/trace_recorder.h"

namespace runnel {

/// Writes into a file what the threads of an application do, from its first cycle on.
///
///     auto application = Application::Load(
///         "robot.xml", {.extensions_by_name = {{"tracing", {{{"trace", "run.json"}}}}}});
///
/// Errors: of loading: the file cannot be made.
class ApplicationTrace final : public ApplicationExtension {
 public:
  explicit ApplicationTrace(std::string file) : file_(std::move(file)) {}

  Result<void> Prepare(FrameworkElement& application, SchedulerOptions& options) override;
  Result<void> Begin(Application& application, Diagnostics& diagnostics) override;
  std::string Finish(Diagnostics& problems) override;
  void Release() noexcept override { recorder_.reset(); }

 private:
  const std::string file_;
  std::unique_ptr<TraceRecorder> recorder_;
};

}  // namespace runnel

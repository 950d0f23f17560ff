#include <memory>
#include <string>
#include <utility>

#include "core/plugin/plugin_entry.h"
#include "plugins/application/application_extension.h"
#include "plugins/tracing/trace_recorder.h"

namespace runnel {

namespace {

/// Writes into a file what the threads of an application do, from its first cycle on.
///
///     auto application = Application::Load(
///         "robot.xml", {.extensions_by_name = {{"tracing", {{{"trace", "run.json"}}}}}});
///
/// Errors: of loading: the file cannot be made.
class ApplicationTrace final : public ApplicationExtension {
 public:
  explicit ApplicationTrace(std::string file) : file_(std::move(file)) {}

  Result<void> Prepare(FrameworkElement& application, SchedulerOptions& options) override {
    auto recorder = TraceRecorder::Start(application.runtime(),
                                         {.file = file_,
                                          .application = application.name(),
                                          .is_simulated = options.clock == SchedulerOptions::ClockKind::kSimulated});
    if (!recorder) return recorder.error();
    recorder_ = std::move(*recorder);
    options.tracer = recorder_.get();
    return {};
  }

  Result<void> Begin(Application& /*application*/, Diagnostics& /*diagnostics*/) override {
    recorder_->FollowStructure();
    return {};
  }

  std::string Finish(Diagnostics& problems) override {
    const auto finished = recorder_->Finish();
    if (!finished) {
      problems.Add(finished.error());
      return {};
    }
    const auto warn = [&](std::uint64_t events, const char* why) {
      if (events == 0) return;
      problems.AddWarning(
          {.message = std::to_string(events) + " events are not in it, as " + why, .position = {file_}});
    };
    warn(finished->lost, "they came faster than they could be written down");
    warn(finished->left_out, "it is as long as a trace may be");
    return "traced " + std::to_string(finished->events) + " events to " + file_ + "\n";
  }

  void Release() noexcept override { recorder_.reset(); }

 private:
  const std::string file_;
  std::unique_ptr<TraceRecorder> recorder_;
};

Result<Extensions> MakeTrace(const ExtensionArguments& arguments) {
  const std::string file = arguments.Find("trace");
  if (file.empty()) return Error{.message = "--trace: '' is not the name of a file"};
  return Extensions{std::make_shared<ApplicationTrace>(file)};
}

}  // namespace

}  // namespace runnel

RUNNEL_PLUGIN(tracing, registry) {
  if (auto* const extensions = registry.Find<runnel::ExtensionRegistry>()) {
    extensions->Add(runnel::MakeTrace);
  }
}

#pragma once

#include <memory>
#include <string>

#include "plugins/application/application_extension.h"
#include "plugins/recording/recorder.h"

namespace runnel {

class Application;

/// What a recording says of an application.
[[nodiscard]] RecordedApplication AboutApplication(Application& application);

/// Records ports of an application into a file, from the first cycle on; and has its clients record others.
///
///     auto application = Application::Load(
///         "robot.xml", {.extensions_by_name = {{"recording", {{{"record", "run.mcap"}}}}}});
///
/// Errors: of loading: see Recorder::Start(). Later ones are events of the application, which goes on.
class ApplicationRecording final : public ApplicationExtension {
 public:
  /// Without a file, for clients only.
  explicit ApplicationRecording(RecorderOptions options = {}) : options_(std::move(options)) {}

  void AddHooks(Application& application, ServiceHooks& hooks) override;
  Result<void> Begin(Application& application, Diagnostics& diagnostics) override;
  std::optional<Error> TakeFailure() override;
  std::string Finish(Diagnostics& problems) override;
  void OnCrash() override {
    if (recorder_ != nullptr) recorder_->FinishFile();
  }
  void End() noexcept override { recorder_.reset(); }

 private:
  RecorderOptions options_;
  std::unique_ptr<Recorder> recorder_;
};

}  // namespace runnel

#include "plugins/recording/application_recording.h"

#include <utility>

#include "plugins/application/application.h"
#include "plugins/recording/recording_text.h"

namespace runnel {

namespace {

// One that a client has begun.
class RecordingOfClient final : public ClientRecording {
 public:
  explicit RecordingOfClient(std::unique_ptr<Recorder> recorder) : recorder_(std::move(recorder)) {}

  std::string Progress() override { return Line(); }
  std::optional<Error> Failure() override { return recorder_->TakeFailure(); }
  Result<std::string> Finish() override {
    if (auto finished = recorder_->Finish(); !finished) return finished.error();
    return Line();
  }

 private:
  // Without its end, which the command adds.
  std::string Line() const {
    std::string text = RecordingText(recorder_->file(), recorder_->status());
    text.pop_back();
    return text;
  }

  const std::unique_ptr<Recorder> recorder_;
};

}  // namespace

RecordedApplication AboutApplication(Application& application) {
  RecordedApplication about{.name = application.name(),
                            .file = application.file(),
                            .text = application.text(),
                            .version = Application::Version()};
  for (const std::string& file : application.options().configurations) {
    about.settings += (about.settings.empty() ? "--config " : " --config ") + file;
  }
  for (const ApplicationSetting& each : application.options().settings) {
    about.settings += (about.settings.empty() ? "" : " ") + each.text;
  }
  return about;
}

void ApplicationRecording::AddHooks(Application& application, ServiceHooks& hooks) {
  hooks.record = [&runtime = application.runtime(), &scheduler = application.scheduler(),
                  about = AboutApplication(application)](
                     const RecordingRequest& request) -> Result<std::unique_ptr<ClientRecording>> {
    auto recorder = Recorder::Start(runtime, &scheduler,
                                    {.file = request.file,
                                     .ports = request.ports,
                                     .compression = request.compression,
                                     .about = about});
    if (!recorder) return recorder.error();
    return std::unique_ptr<ClientRecording>(
        std::make_unique<RecordingOfClient>(std::move(*recorder)));
  };
}

Result<void> ApplicationRecording::Begin(Application& application, Diagnostics& /*diagnostics*/) {
  if (options_.file.empty()) return {};
  options_.about = AboutApplication(application);
  auto recorder = Recorder::Start(application.runtime(), &application.scheduler(), options_);
  if (!recorder) return recorder.error();
  recorder_ = std::move(*recorder);
  return {};
}

std::optional<Error> ApplicationRecording::TakeFailure() {
  return recorder_ != nullptr ? recorder_->TakeFailure() : std::nullopt;
}

std::string ApplicationRecording::Finish(Diagnostics& problems) {
  if (recorder_ == nullptr) return {};
  if (const auto finished = recorder_->Finish(); !finished) problems.Add(finished.error());
  (void)recorder_->TakeFailure();  // the same
  return RecordingText(recorder_->file(), recorder_->status());
}

}  // namespace runnel

#include <iterator>
#include <memory>
#include <mutex>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/element/element_path.h"
#include "core/element/file_notes.h"
#include "core/module/module.h"
#include "core/plugin/plugin_entry.h"
#include "core/port/output.h"
#include "core/port/port.h"
#include "core/xml/xml_document.h"
#include "core/xml/xml_reading.h"
#include "plugins/application/application.h"
#include "plugins/application/application_extension.h"
#include "plugins/parameters/file_path.h"
#include "plugins/parameters/parameter.h"
#include "plugins/recording/application_replay.h"
#include "plugins/recording/recorder.h"
#include "plugins/recording/recording_info.h"

namespace runnel {

namespace {

std::vector<std::string> Words(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

}  // namespace

/// What a recorder in an application says of itself.
struct RecorderState {
  std::uint64_t values = 0;
  std::uint64_t dropped = 0;
  std::uint64_t bytes = 0;
};
inline void Describe(TypeBuilder<RecorderState>& type) {
  type.Name("RecorderState")
      .Field("values", &RecorderState::values, {.description = "written so far"})
      .Field("dropped", &RecorderState::dropped, {.description = "came too fast, or could not be written"})
      .Field("bytes", &RecorderState::bytes, {.unit = "B", .description = "of the file"});
}

/// A Recorder as a module, for applications that always record. Begins when the application is ready, and
/// ends with it. A recording that cannot go on (a full disk) is a fault of this module.
///
/// Threads:  Update() asks the recorder how it is going. On a simulated clock it waits there until the
///           recorder has caught up, so run it in the thread whose modules publish fastest.
class RecorderModule final : public Module {
 public:
  using Module::Module;

  StaticParameter<FilePath> file{
      this, "file", {.description = "the file (MCAP) to record to; it must not be there yet"}};
  StaticParameter<std::string> ports{
      this, "ports", {.description = "patterns, with blanks between: /robot/** */pose !**/scan; empty: all outputs"}};
  StaticParameter<std::string> compression{
      this, "compression", {.description = "zstd, lz4, none; empty: the first that is there"}};
  Output<RecorderState> state{this, "state"};

 private:
  Result<void> Prepare() override {
    if (file.Get().empty()) {
      return Error{.message = "needs the file to record to, as parameter 'file'", .path = path()};
    }
    is_simulated_ = dynamic_cast<const ManualClock*>(&runtime().clock()) != nullptr;
    RecordedApplication about{.name = std::string(SplitPath(path()).front())};
    {
      const std::lock_guard lock(runtime().structure_mutex());
      about.file = FindSourcePlace(*this).file;
    }
    // A recorder that was made while the application runs stands in no file.
    if (auto text = XmlDocument::ReadText(about.file)) about.text = std::move(*text);
    auto started = Recorder::Start(runtime(), nullptr,
                                   {.file = file.Get().path().string(),
                                    .ports = Words(ports.Get()),
                                    .compression = compression.Get(),
                                    .about = std::move(about)});
    if (!started) return started.error().WithPath(path());
    recorder_ = std::move(*started);
    return {};
  }

  void Update() override {
    if (is_simulated_) recorder_->WaitForRoom();
    if (const auto failure = recorder_->TakeFailure()) {
      throw std::runtime_error("the recording: " + failure->ToString());
    }
    const RecordingStatus status = recorder_->status();
    state.Publish({status.values, status.dropped, status.bytes});
  }

  std::unique_ptr<Recorder> recorder_;
  bool is_simulated_ = false;
};

namespace {

// "recorded 1234 values of 5 ports, 1.2 MB, to run.mcap", with what was lost.
std::string RecordingText(const Recorder& recorder) {
  const RecordingStatus status = recorder.status();
  std::string text = "recorded " + std::to_string(status.values) + " values of " + std::to_string(status.ports) +
                     (status.ports == 1 ? " port, " : " ports, ") + SizeText(status.bytes) + ", to " + recorder.file();
  if (status.dropped > 0) {
    text += "; " + std::to_string(status.dropped) + " came too fast or could not be written, and are not in it";
  }
  if (status.unwritable) text += "; " + status.unwritable->ToString();
  if (!status.left_out.empty()) {
    text += "; not recorded, because their values have no form to be written in:";
    for (const std::string& path : status.left_out) text += " " + ShortPortPath(path);
  }
  if (!status.idle_patterns.empty()) {
    text += "; no port has fitted";
    for (const std::string& pattern : status.idle_patterns) text += " '" + pattern + "'";
  }
  return text;
}

// One that a client has begun.
class RecordingOfClient final : public ClientRecording {
 public:
  explicit RecordingOfClient(std::unique_ptr<Recorder> recorder) : recorder_(std::move(recorder)) {}

  std::string Progress() override { return RecordingText(*recorder_); }
  std::optional<Error> Failure() override { return recorder_->status().failure; }
  Result<std::string> Finish() override {
    if (auto finished = recorder_->Finish(); !finished) return finished.error();
    return RecordingText(*recorder_);
  }

 private:
  const std::unique_ptr<Recorder> recorder_;
};

// What a recording says of an application.
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

  void AddHooks(Application& application, ServiceHooks& hooks) override {
    hooks.record = [&runtime = application.runtime(), &scheduler = application.scheduler(),
                    about = AboutApplication(application)](
                       const RecordingRequest& request) -> Result<std::unique_ptr<ClientRecording>> {
      auto recorder = Recorder::Start(
          runtime, &scheduler,
          {.file = request.file, .ports = request.ports, .compression = request.compression, .about = about});
      if (!recorder) return recorder.error();
      return std::unique_ptr<ClientRecording>(std::make_unique<RecordingOfClient>(std::move(*recorder)));
    };
  }

  Result<void> Begin(Application& application, Diagnostics& /*diagnostics*/) override {
    if (options_.file.empty()) return {};
    options_.about = AboutApplication(application);
    auto recorder = Recorder::Start(application.runtime(), &application.scheduler(), options_);
    if (!recorder) return recorder.error();
    recorder_ = std::move(*recorder);
    return {};
  }

  std::optional<Error> TakeFailure() override { return recorder_ != nullptr ? recorder_->TakeFailure() : std::nullopt; }

  std::string Finish(Diagnostics& problems) override {
    if (recorder_ == nullptr) return {};
    if (const auto finished = recorder_->Finish(); !finished) problems.Add(finished.error());
    (void)recorder_->TakeFailure();  // the same
    return RecordingText(*recorder_) + "\n";
  }

  void OnCrash() override {
    if (recorder_ != nullptr) recorder_->FinishFile();
  }
  void End() noexcept override { recorder_.reset(); }

 private:
  RecorderOptions options_;
  std::unique_ptr<Recorder> recorder_;
};

// nullopt: not given.
Result<std::optional<Duration>> ReadSeconds(const ExtensionArguments& arguments, const std::string& option) {
  constexpr double kLongest = 9e9;
  if (!arguments.Has(option)) return std::optional<Duration>();
  const std::string text = arguments.Find(option);
  const auto number = ParseNumber(text);
  if (number && *number >= 0 && *number <= kLongest) return std::optional(FromSeconds(*number));
  return Error{.message = "--" + option + ": '" + text + "' is not a number of seconds from 0 to 9e9"};
}

Result<std::shared_ptr<ApplicationExtension>> ReplayOf(const ExtensionArguments& arguments) {
  const auto from = ReadSeconds(arguments, "from");
  if (!from) return from.error();
  const auto to = ReadSeconds(arguments, "to");
  if (!to) return to.error();
  return MakeReplay(arguments.Find("recording"),
                    {.ports = arguments.All("ports"), .from = *from, .to = *to, .loops = arguments.Has("loop")});
}

// What is played begins first: its values are recorded.
Result<Extensions> MakeRecordings(const ExtensionArguments& arguments) {
  Extensions made;
  if (arguments.Has("recording")) {
    const auto replay = ReplayOf(arguments);
    if (!replay) return replay.error();
    made.push_back(*replay);
  }
  const std::string file = arguments.Find("record");
  for (const char* const option : {"record", "record-ports", "record-compression"}) {
    if (arguments.Has(option) && file.empty()) {
      return Error{.message = std::string("--") + option + " needs the file to record to",
                   .hint = "add --record FILE.mcap"};
    }
  }
  made.push_back(std::make_shared<ApplicationRecording>(RecorderOptions{
      .file = file, .ports = arguments.All("record-ports"), .compression = arguments.Find("record-compression")}));
  return made;
}

}  // namespace

}  // namespace runnel

RUNNEL_PLUGIN(recording, registry) {
  registry.Add<runnel::RecorderModule>("recording/recorder", "records what ports publish into an MCAP file");
  if (auto* const extensions = registry.Find<runnel::ExtensionRegistry>()) {
    extensions->Add(runnel::MakeRecordings);
  }
}

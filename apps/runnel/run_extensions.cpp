#include "apps/runnel/run_extensions.h"

#include "apps/runnel/chosen_application.h"

namespace runnel::program {

namespace {

using ClockKind = SchedulerOptions::ClockKind;

// Says in the words of the command line what cannot be had of real time.
class ClockWords final : public ApplicationExtension {
 public:
  explicit ClockWords(const RunArguments& arguments) : arguments_(arguments) {}

  Result<void> Prepare(FrameworkElement& /*application*/, SchedulerOptions& options) override {
    const auto refuse = [&](const char* message, const std::string& words) {
      return Error{
          .message = message,
          .position = {arguments_.application.file},
          .hint = "leave out " + words + ", or add <clock type=\"simulated\"/> to the application"};
    };
    if (options.clock != ClockKind::kReal) return {};
    if (arguments_.speed) {
      return refuse("the speed of real time cannot be chosen", "--fast and --speed");
    }
    if (arguments_.is_paused) return refuse("real time cannot be paused", "--paused");
    return {};
  }

 private:
  const RunArguments& arguments_;  // outlive the run
};

ViewerOptions OptionsOf(const InspectArguments& arguments) {
  const bool is_usual = arguments.place == InspectArguments::kUsualPlace;
  return {.is_wanted = arguments.is_wanted(),
          .is_refused = arguments.is_refused,
          .place = is_usual ? "" : arguments.place,
          .token = arguments.token,
          .origins = arguments.origins,
          .is_read_only = arguments.is_read_only};
}

std::optional<Duration> Seconds(const std::optional<double>& seconds) {
  if (!seconds) return {};
  return FromSeconds(*seconds);
}

PlayerOptions OptionsOf(const ReplayArguments& arguments) {
  return {.ports = arguments.ports,
          .from = Seconds(arguments.from),
          .to = Seconds(arguments.to),
          .loops = arguments.loops};
}

RecorderOptions OptionsOf(const RecordArguments& arguments) {
  return {.file = arguments.file, .ports = arguments.ports, .compression = arguments.compression};
}

}  // namespace

bool IsWithoutApplication(const RunArguments& arguments) {
  return arguments.replay && arguments.application.file.empty();
}

RunExtensions::RunExtensions(const RunArguments& arguments)
    : viewers(std::make_shared<Viewers>(OptionsOf(arguments.inspect))),
      recording(std::make_shared<ApplicationRecording>(OptionsOf(arguments.record))) {
  if (!arguments.trace.empty()) trace = std::make_shared<ApplicationTrace>(arguments.trace);
  if (arguments.replay) {
    replay =
        std::make_shared<ApplicationReplay>(arguments.replay->file, OptionsOf(*arguments.replay));
  }
}

ApplicationOptions RunExtensions::Options(const RunArguments& arguments) const {
  ApplicationOptions options = program::OptionsOf(arguments.application, viewers);
  options.speed = arguments.speed;
  options.is_paused = arguments.is_paused;
  options.has_control = arguments.has_control;
  if (IsWithoutApplication(arguments)) options.clock = ClockKind::kSimulated;
  auto& extensions = options.extensions;
  if (replay) extensions.insert(extensions.begin(), replay);
  if (trace) extensions.insert(extensions.begin(), trace);
  extensions.insert(extensions.begin(), std::make_shared<ClockWords>(arguments));
  extensions.push_back(recording);
  return options;
}

}  // namespace runnel::program

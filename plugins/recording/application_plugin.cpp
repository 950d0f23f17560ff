#include <memory>
#include <optional>
#include <string>

#include "core/plugin/plugin_entry.h"
#include "core/xml/xml_reading.h"
#include "plugins/application/extension_registry.h"
#include "plugins/recording/application_recording.h"
#include "plugins/recording/application_replay.h"
#include "plugins/recording/recorder_module.h"

namespace runnel {

namespace {

// nullopt: not given.
Result<std::optional<Duration>> ReadSeconds(const ExtensionArguments& arguments,
                                            const std::string& option) {
  constexpr double kLongest = 9e9;
  if (!arguments.Has(option)) return std::optional<Duration>();
  const std::string text = arguments.Find(option);
  const auto number = ParseNumber(text);
  if (number && *number >= 0 && *number <= kLongest) return std::optional(FromSeconds(*number));
  return Error{.message =
                   "--" + option + ": '" + text + "' is not a number of seconds from 0 to 9e9"};
}

Result<std::shared_ptr<ApplicationReplay>> MakeReplay(const ExtensionArguments& arguments) {
  const auto from = ReadSeconds(arguments, "from");
  if (!from) return from.error();
  const auto to = ReadSeconds(arguments, "to");
  if (!to) return to.error();
  return std::make_shared<ApplicationReplay>(arguments.Find("recording"),
                                             PlayerOptions{.ports = arguments.All("ports"),
                                                           .from = *from,
                                                           .to = *to,
                                                           .loops = arguments.Has("loop")});
}

// What is played begins first: its values are recorded.
Result<Extensions> MakeRecordings(const ExtensionArguments& arguments) {
  Extensions made;
  if (arguments.Has("recording")) {
    const auto replay = MakeReplay(arguments);
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
  made.push_back(std::make_shared<ApplicationRecording>(
      RecorderOptions{.file = file,
                      .ports = arguments.All("record-ports"),
                      .compression = arguments.Find("record-compression")}));
  return made;
}

}  // namespace

}  // namespace runnel

RUNNEL_PLUGIN(recording, registry) {
  registry.Add<runnel::RecorderModule>("recording/recorder",
                                       "records what ports publish into an MCAP file");
  if (auto* const extensions = registry.Find<runnel::ExtensionRegistry>()) {
    extensions->Add(runnel::MakeRecordings);
  }
}

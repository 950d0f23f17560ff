#include "apps/runnel/recording_command_line.h"

#include "core/xml/xml_reading.h"
#include "plugins/scheduling/pacing.h"

namespace runnel::program {

namespace {

constexpr const char* kPatterns =
    "which ports: /robot/pose, */pose, /robot/**; '!' in front: not those; may be given several "
    "times";

std::string CheckRate(const std::string& text) {
  const auto number = ParseNumber(text);
  return number && Pacing::Takes(*number)
             ? ""
             : "'" + text + "' is neither 0 (as fast as it can) nor a factor from 1e-6 to 1e6";
}
std::string CheckSeconds(const std::string& text) {
  constexpr double kLongest = 9e9;
  const auto number = ParseNumber(text);
  return number && *number >= 0 && *number <= kLongest
             ? ""
             : "'" + text + "' is not a number of seconds from 0 to 9e9";
}

}  // namespace

void AddRecordOptions(CLI::App& command, RecordArguments& arguments) {
  const auto file =
      command.add_option("--record", arguments.file, "records what ports publish, as MCAP")
          ->type_name("FILE.mcap");
  command.add_option("--record-ports", arguments.ports, kPatterns)
      ->type_name("PATTERN")
      ->allow_extra_args(false)
      ->needs(file);
  command
      .add_option("--record-compression", arguments.compression,
                  "zstd, lz4 or none; without, the first that is there")
      ->type_name("WORD")
      ->needs(file);
}

const std::vector<std::string>& RecordingCommandLine::Names() {
  static const std::vector<std::string> names{"replay", "info"};
  return names;
}

RecordingCommandLine::RecordingCommandLine(CLI::App& program)
    : replay_(program.add_subcommand(
          "replay", "publishes what was recorded, into an application or for viewers alone")),
      info_(program.add_subcommand("info", "says what is in a recording")) {
  AddReplay();
  info_->add_option("recording", info_arguments_.file, "file (MCAP)")
      ->required()
      ->type_name("FILE.mcap");
  info_->add_flag("--json", info_arguments_.is_json, "for programs");
}

void RecordingCommandLine::AddReplay() {
  replay_->add_option("recording", replayed_.file, "file (MCAP)")
      ->required()
      ->type_name("FILE.mcap");
  replay_
      ->add_option("application", replay_arguments_.application.file,
                   "application file (XML): recorded ports are played instead of what its modules "
                   "publish there; without, ports are made for all that is recorded")
      ->type_name("FILE.xml");
  replay_
      ->add_option("settings", replay_arguments_.application.settings,
                   "values for parameters of the application")
      ->type_name("NAME=VALUE");
  replay_->add_option("--ports", replayed_.ports, kPatterns)
      ->type_name("PATTERN")
      ->allow_extra_args(false);
  replay_->add_option("--rate", replayed_.rate, "1 is real time (usual), 0 as fast as it can")
      ->type_name("FACTOR")
      ->check(CheckRate);
  replay_->add_flag("--paused", replay_arguments_.is_paused,
                    "begins with a pause: 'runnel resume' or 'runnel step' go on");
  replay_->add_flag("--step", replayed_.steps, "paused; each Enter runs one cycle");
  replay_->add_option("--from", replayed_.from, "begins so long after the recording's start")
      ->type_name("SECONDS")
      ->check(CheckSeconds);
  replay_->add_option("--to", replayed_.to, "ends so long after the recording's start")
      ->type_name("SECONDS")
      ->check(CheckSeconds);
  replay_->add_flag("--loop", replayed_.loops, "again and again, until Ctrl-C");
}

std::optional<CommandLine> RecordingCommandLine::Parsed() const {
  if (info_->parsed()) return info_arguments_;
  if (!replay_->parsed()) return {};
  RunArguments arguments = replay_arguments_;
  arguments.replay = replayed_;
  arguments.speed = replayed_.rate;
  arguments.is_paused = arguments.is_paused || replayed_.steps;
  return arguments;
}

}  // namespace runnel::program

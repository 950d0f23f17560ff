#include "apps/runnel/command_line.h"

#include <algorithm>
#include <iostream>

#include <CLI/CLI.hpp>

#include "apps/runnel/control_command_line.h"
#include "apps/runnel/other_programs.h"
#include "apps/runnel/recording_command_line.h"
#include "core/base/nearest_name.h"
#include "core/xml/xml_reading.h"
#include "plugins/inspector/inspector_place.h"
#include "plugins/scheduling/pacing.h"
#include "plugins/web_server/access_rules.h"

namespace runnel::program {

namespace {

const std::vector<std::string> kCommands{"run", "check", "modules", "schema", "graph", "version"};

ExitCode Refuse(const std::string& message, const std::string& hint) {
  std::cerr << "error: " << message << "; " << hint << '\n';
  return ExitCode::kBadInput;
}

std::vector<std::string> AllCommands() {
  std::vector<std::string> commands = kCommands;
  for (const std::string& command : ControlCommandLine::Names()) commands.push_back(command);
  for (const std::string& command : RecordingCommandLine::Names()) commands.push_back(command);
  for (const std::string& command : OtherCommands()) commands.push_back(command);
  return commands;
}

// Of those that are programs of their own; each has its own --help.
std::string FooterText() {
  std::string others;
  for (const std::string& command : OtherCommands()) {
    others += (others.empty() ? "" : ", ") + command;
  }
  return (others.empty() ? "" : "Further commands, each with its own --help: " + others + "\n") +
         "Exit codes: 0 done, 1 the run failed, 2 bad input.";
}

bool IsUnknownCommand(const std::string& word) {
  const auto names = AllCommands();
  return !word.starts_with('-') && std::ranges::find(names, word) == names.end();
}

// CLI11's own checks name bounds with three hundred digits.
std::string CheckSpeed(const std::string& text) {
  const auto number = ParseNumber(text);
  return number && Pacing::Takes(*number)
             ? ""
             : "'" + text + "' is neither 0 (as fast as it can) nor a factor from 1e-6 to 1e6";
}
// A Duration holds no more.
std::string CheckDuration(const std::string& text) {
  constexpr double kLongest = 9e9;
  const auto number = ParseNumber(text);
  return number && *number > 0 && *number <= kLongest
             ? ""
             : "'" + text + "' is not a number of seconds above 0 and up to 9e9";
}
std::string CheckFile(const std::string& text) {
  return text.empty() ? "'' is not the name of a file" : "";
}

void AddApplicationArguments(CLI::App& command, ApplicationArguments& arguments) {
  command.add_option("application", arguments.file, "application file (XML)")
      ->required()
      ->type_name("FILE")
      ->check(CheckFile);
  command
      .add_option("settings", arguments.settings,
                  "values for parameters, by the names that the application gives them in "
                  "command_line=\"…\"")
      ->type_name("NAME=VALUE");
  // One file each time, since the application and settings come after it.
  command
      .add_option("--config", arguments.configurations,
                  "configuration file (XML), may be given several times")
      ->type_name("FILE")
      ->allow_extra_args(false);
}

std::string CheckPlace(const std::string& text) {
  if (text == InspectArguments::kUsualPlace) return "";
  const auto place = ParseInspectorPlace(text);
  return place ? "" : place.error().ToString();
}
std::string CheckInspectToken(const std::string& text) {
  const auto good = CheckToken(text);
  return good ? "" : good.error().ToString();
}

void AddInspect(CLI::App& run, InspectArguments& arguments) {
  // A flag that may have a value, so that the word after it is not taken for one.
  run.add_flag("--inspect", arguments.place,
               "shows the application in a browser: --inspect, --inspect=PORT or "
               "--inspect=ADDRESS:PORT")
      ->check(CheckPlace);
  run.add_option("--inspect-token", arguments.token,
                 "what viewers must show; made at random if others than this machine can reach the "
                 "address")
      ->type_name("TOKEN")
      ->check(CheckInspectToken);
  run.add_flag("--inspect-read-only", arguments.is_read_only, "viewers change nothing");
  run.add_option("--inspect-origin", arguments.origins,
                 "pages of other places that may connect, may be given several times")
      ->type_name("URL")
      ->allow_extra_args(false);
  const auto none = run.add_flag("--no-inspect", arguments.is_refused,
                                 "no inspector, whatever the application file says");
  run.add_flag("--hold", arguments.hold, "when the run has ended, viewers can go on until Ctrl-C")
      ->excludes(none);
}

// The same for whatever is run.
void AddWhatAccompaniesARun(CLI::App& run, RunArguments& arguments) {
  run.add_option("--duration", arguments.duration, "ends the run after so long, simulated or real")
      ->type_name("SECONDS")
      ->check(CheckDuration);
  run.add_flag("--quiet", arguments.quiet, "no progress, only how the run ended");
  run.add_flag("--statistics", arguments.statistics,
               "at the end, how punctual the threads were and how long their cycles took");
  run.add_option("--trace", arguments.trace,
                 "writes cycles, updates and publications into a file (JSON) for ui.perfetto.dev")
      ->type_name("FILE")
      ->check(CheckFile);
  run.add_flag_callback(
      "--no-control", [&arguments] { arguments.has_control = false; },
      "no other process can look at it or change it");
  AddInspect(run, arguments.inspect);
  AddRecordOptions(run, arguments.record);
}

CLI::App& AddRun(CLI::App& program, RunArguments& arguments) {
  CLI::App& run = *program.add_subcommand("run", "runs an application until it ends, or Ctrl-C");
  AddApplicationArguments(run, arguments.application);
  const auto fast = run.add_flag_callback(
      "--fast", [&arguments] { arguments.speed = 0; }, "simulated time passes as fast as it can");
  run.add_option("--speed", arguments.speed, "of simulated time; 1 is real time")
      ->type_name("FACTOR")
      ->check(CheckSpeed)
      ->excludes(fast);
  run.add_flag("--paused", arguments.is_paused,
               "simulated time stands still until 'runnel resume' or 'runnel step'");
  AddWhatAccompaniesARun(run, arguments);
  return run;
}

}  // namespace

CommandLine ParseCommandLine(int count, const char* const* words) {
  CLI::App program("Runs robot applications that are described in XML files.", "runnel");
  program.require_subcommand(1);
  program.set_version_flag("--version", "runnel " RUNNEL_VERSION, "says which version this is");
  program.footer(FooterText());
  RunArguments run_arguments;
  CheckArguments check_arguments;
  ModulesArguments modules_arguments;
  SchemaArguments schema_arguments;
  GraphArguments graph_arguments;

  const CLI::App& run = AddRun(program, run_arguments);
  CLI::App& check = *program.add_subcommand("check", "looks for mistakes, without running");
  AddApplicationArguments(check, check_arguments.application);
  CLI::App& modules = *program.add_subcommand("modules", "lists module types, ports, parameters");
  modules.add_option("plugins", modules_arguments.plugins, "only of these; without, of all")
      ->type_name("PLUGIN");
  modules.add_flag("--names", modules_arguments.names_only, "only the names of the types");
  CLI::App& schema = *program.add_subcommand(
      "schema", "writes the XML schema of application files, for editors and checkers");
  schema.add_option("plugins", schema_arguments.plugins, "only of these; without, of all")
      ->type_name("PLUGIN");
  schema.add_option("-o,--output", schema_arguments.output, "file; without, standard output")
      ->type_name("FILE")
      ->check(CheckFile);
  CLI::App& graph = *program.add_subcommand("graph", "draws the data flow of an application");
  AddApplicationArguments(graph, graph_arguments.application);
  graph.add_option("-o,--output", graph_arguments.output, "file: .svg, .png, .pdf or .dot")
      ->required()
      ->type_name("FILE")
      ->check(CheckFile);
  program.add_subcommand("version", "says which version this is");
  const ControlCommandLine control(program);
  RecordingCommandLine recording(program);
  AddWhatAccompaniesARun(recording.replay(), recording.replay_arguments());

  if (count > 1 && IsUnknownCommand(words[1])) {
    return Refuse("there is no command '" + std::string(words[1]) + "'",
                  NearestNameHint(words[1], AllCommands()));
  }
  try {
    const auto all = WithNegativeValues(count, words);
    program.parse(static_cast<int>(all.size()), all.data());
  } catch (const CLI::Success& help) {
    program.exit(help);
    return ExitCode::kDone;
  } catch (const CLI::ParseError& error) {
    return Refuse(error.what(), "see 'runnel --help' or 'runnel run --help'");
  }
  if (run.parsed()) return run_arguments;
  if (check.parsed()) return check_arguments;
  if (modules.parsed()) return modules_arguments;
  if (schema.parsed()) return schema_arguments;
  if (graph.parsed()) return graph_arguments;
  if (auto arguments = control.Parsed()) return *arguments;
  if (auto arguments = recording.Parsed()) return *arguments;
  return VersionArguments{};
}

}  // namespace runnel::program

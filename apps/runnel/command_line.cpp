#include "apps/runnel/command_line.h"

#include <algorithm>
#include <iostream>

#include <CLI/CLI.hpp>
#include <fmt/ranges.h>

#include "apps/runnel/commands.h"
#include "apps/runnel/control_command_line.h"
#include "apps/runnel/extension_command_line.h"
#include "apps/runnel/other_programs.h"
#include "apps/runnel/output.h"
#include "core/base/nearest_name.h"
#include "core/plugin/plugin_manager.h"
#include "core/xml/xml_reading.h"
#include "plugins/timing/pacing.h"

namespace runnel::program {

namespace {

using Command = std::function<ExitCode()>;

Command Ends(ExitCode code) {
  return [code] { return code; };
}

Command Refuse(const std::string& message, const std::string& hint) {
  std::cerr << "error: " << message << "; " << hint << '\n';
  return Ends(ExitCode::kBadInput);
}

std::vector<std::string> AllCommands(const CLI::App& program) {
  std::vector<std::string> commands;
  for (const CLI::App* each : program.get_subcommands({})) commands.push_back(each->get_name());
  for (const std::string& command : OtherCommands()) commands.push_back(command);
  return commands;
}

// Of those that are programs of their own; each has its own --help.
std::string FooterText() {
  const std::string others = fmt::format("{}", fmt::join(OtherCommands(), ", "));
  return (others.empty() ? "" : "Further commands, each with its own --help: " + others + "\n") +
         "Exit codes: 0 done, 1 the run failed, 2 bad input.";
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

// The same for whatever is run.
void AddWhatAccompaniesARun(CLI::App& run, RunArguments& arguments) {
  run.add_option("--duration", arguments.duration, "ends the run after so long, simulated or real")
      ->type_name("SECONDS")
      ->check(CheckDuration);
  run.add_flag("--quiet", arguments.quiet, "no progress, only how the run ended");
  run.add_flag("--statistics", arguments.statistics,
               "at the end, how punctual the threads were and how long their cycles took");
  run.add_flag("--profile", arguments.is_profiled,
               "measures how long each module takes, and says so at the end");
  run.add_option("--log", arguments.log_file,
                 "writes faults, warnings, changes and what modules say into a file")
      ->type_name("FILE");
  run.add_option("--crash-report", arguments.crash_file,
                 "where a crash is told besides (runnel_crash_PROCESS.txt); '': nowhere")
      ->type_name("FILE");
  run.add_flag_callback(
      "--no-control", [&arguments] { arguments.has_control = false; },
      "no other process can look at it or change it");
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

CLI::App& AddReplay(CLI::App& program, RunArguments& arguments) {
  CLI::App& replay = *program.add_subcommand(
      "replay", "publishes what was recorded, into an application or for viewers alone");
  replay.add_option("--rate", arguments.speed, "1 is real time (usual), 0 as fast as it can")
      ->type_name("FACTOR")
      ->check(CheckSpeed);
  replay.add_flag("--paused", arguments.is_paused,
                  "begins with a pause: 'runnel resume' or 'runnel step' go on");
  replay.add_flag("--step", arguments.steps, "paused; each Enter runs one cycle");
  AddWhatAccompaniesARun(replay, arguments);
  return replay;
}

// After what is replayed.
void AddReplayedApplication(CLI::App& replay, ApplicationArguments& arguments) {
  replay
      .add_option("application", arguments.file,
                  "application file (XML): recorded ports are played instead of what its modules "
                  "publish there; without, ports are made for all that is recorded")
      ->type_name("FILE.xml");
  replay.add_option("settings", arguments.settings, "values for parameters of the application")
      ->type_name("NAME=VALUE");
}

}  // namespace

ApplicationOptions ApplicationArguments::Options() const {
  ApplicationOptions options{.configurations = configurations};
  for (const std::string& each : settings) options.settings.emplace_back(each);
  return options;
}

Command ParseCommandLine(int count, const char* const* words) {
  const auto catalogue = ExtensionCatalogue::Read(PluginManager().search_path());
  if (!catalogue) {
    PrintError(catalogue.error());
    return Ends(ExitCode::kBadInput);
  }
  CLI::App program("Runs robot applications that are described in XML files.", "runnel");
  program.require_subcommand(1);
  program.set_version_flag("--version", "runnel " RUNNEL_VERSION, "says which version this is");
  program.footer(FooterText());
  RunArguments run_arguments;
  RunArguments replay_arguments;
  ApplicationArguments check_arguments;
  ModulesArguments modules_arguments;
  SchemaArguments schema_arguments;
  GraphArguments graph_arguments;

  CLI::App& run = AddRun(program, run_arguments);
  const ExtensionCommandLine run_extensions(*catalogue, run);
  CLI::App& replay = AddReplay(program, replay_arguments);
  const ExtensionCommandLine replay_extensions(*catalogue, replay);
  AddReplayedApplication(replay, replay_arguments.application);
  CLI::App& check = *program.add_subcommand("check", "looks for mistakes, without running");
  AddApplicationArguments(check, check_arguments);
  CLI::App& modules = *program.add_subcommand("modules", "lists module types, ports, parameters");
  modules.add_option("plugins", modules_arguments.plugins, "only of these; without, of all")
      ->type_name("PLUGIN");
  CLI::Option* const names =
      modules.add_flag("--names", modules_arguments.names_only, "only the names of the types");
  modules.add_flag("--json", modules_arguments.as_json, "all that is known of them, as JSON")
      ->excludes(names);
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

  const std::string command = count > 1 ? words[1] : "";
  const std::vector<std::string> all_commands = AllCommands(program);
  const bool is_known = std::ranges::count(all_commands, command) > 0;
  if (count > 1 && !command.starts_with('-') && !is_known) {
    if (const auto* const extension = catalogue->FindCommand(command)) {
      return Refuse(
          "'" + command + "' is of the extension '" + extension->name + "', which is not installed",
          "it " + extension->summary);
    }
    return Refuse("there is no command '" + command + "'", NearestNameHint(command, all_commands));
  }
  try {
    const auto all = WithNegativeValues(count, words);
    program.parse(static_cast<int>(all.size()), all.data());
  } catch (const CLI::Success& help) {
    program.exit(help);
    return Ends(ExitCode::kDone);
  } catch (const CLI::ParseError& error) {
    return Refuse(error.what(), "see 'runnel --help' or 'runnel run --help'");
  }
  run_arguments.extensions = run_extensions.Chosen();
  run_arguments.preloads = run_extensions.Preloads();
  replay_arguments.extensions = replay_extensions.Chosen();
  replay_arguments.preloads = replay_extensions.Preloads();
  replay_arguments.is_paused = replay_arguments.is_paused || replay_arguments.steps;
  if (run.parsed()) return [=] { return Run(run_arguments); };
  if (replay.parsed()) return [=] { return Run(replay_arguments); };
  if (check.parsed()) return [=] { return Check(check_arguments); };
  if (modules.parsed()) return [=] { return ListModules(modules_arguments); };
  if (schema.parsed()) return [=] { return WriteSchema(schema_arguments); };
  if (graph.parsed()) return [=] { return DrawGraph(graph_arguments); };
  if (auto arguments = control.Parsed()) return [=] { return Control(*arguments); };
  return [] {
    std::cout << "runnel " RUNNEL_VERSION "\n";
    return ExitCode::kDone;
  };
}

}  // namespace runnel::program

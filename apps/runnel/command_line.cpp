#include "apps/runnel/command_line.h"

#include <algorithm>
#include <array>
#include <iostream>

#include <CLI/CLI.hpp>
#include <fmt/ranges.h>

#include "apps/runnel/control_command_line.h"
#include "apps/runnel/extension_command_line.h"
#include "apps/runnel/meant_application.h"
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

// "--app NAME ls" for "ls --app NAME".
std::vector<const char*> WithCommandFirst(int count, const char* const* words) {
  std::vector<const char*> all(words, words + count);
  const std::string_view first = count > 1 ? words[1] : "";
  const std::ptrdiff_t taken = first == "--app" ? 2 : first.starts_with("--app=") ? 1 : 0;
  if (taken > 0 && count > taken + 1) std::rotate(all.begin() + 1, all.begin() + 1 + taken, all.begin() + 2 + taken);
  return all;
}

// Long ones, as they are written.
std::vector<std::string> OptionNames(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* each : command.get_options()) {
    for (const std::string& name : each->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

const CLI::App* FindCommand(const CLI::App& program, const std::string& name) {
  const auto has_name = [&](const CLI::App* each) { return each->get_name() == name; };
  const auto found = program.get_subcommands(has_name);
  return found.empty() ? nullptr : found.front();
}

// For the completion of shells that have no rules of their own.
ExitCode CompleteAll(const std::vector<std::string>& typed, const std::vector<std::string>& commands,
                     const std::vector<std::string>& options) {
  const std::string& last = typed.back();
  if (typed.size() > 1 && !last.starts_with('-')) return Complete({.command = "complete", .words = typed});
  for (const std::string& each : typed.size() == 1 ? commands : options) {
    if (each.starts_with(last) && each != "complete") std::cout << each << '\n';
  }
  return ExitCode::kDone;
}

// What is wrong, in the words of somebody who knows what was meant.
Command RefuseParsing(const CLI::App& program, const CLI::ParseError& error) {
  const std::vector<CLI::App*> parsed = program.get_subcommands();
  const std::string name = parsed.empty() ? "" : parsed.front()->get_name();
  const std::string help = name.empty() ? "see 'runnel help'" : "see 'runnel help " + name + "'";
  if (parsed.empty()) return Refuse(error.what(), help);
  const std::vector<std::string> left = parsed.front()->remaining();
  if (name == "stop" && !left.empty() && !left.front().starts_with('-')) {
    return Refuse("'runnel stop' is the STOP of the robot, and takes no path",
                  "'runnel pause PATH' leaves modules out of cycles, 'runnel block PORT' stops one port");
  }
  const auto unknown = std::ranges::find_if(left, [](const std::string& each) { return each.starts_with('-'); });
  if (unknown != left.end()) {
    const std::string option = unknown->substr(0, unknown->find('='));
    if (name == "run" && option == "--inspect") {
      return Refuse("what shows applications in a browser is not installed", "Debian's package is runnel-inspector");
    }
    const std::string nearest = NearestName(option, OptionNames(*parsed.front()));
    return Refuse("'" + name + "' has no option '" + option + "'",
                  nearest.empty() ? help : "did you mean '" + nearest + "'?");
  }
  if (!left.empty()) return Refuse("'" + left.front() + "' is one word too many for '" + name + "'", help);
  return Refuse("'" + name + "': " + error.what(), help);
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
std::string CheckFile(const std::string& text) { return text.empty() ? "'' is not the name of a file" : ""; }

void AddApplicationArguments(CLI::App& command, ApplicationArguments& arguments) {
  command
      .add_option("application", arguments.file, "application file (XML), or the name of one that comes with Runnel")
      ->required()
      ->type_name("FILE")
      ->check(CheckFile)
      ->transform(ApplicationFile);
  command
      .add_option("settings", arguments.settings,
                  "values for parameters, by the names that the application gives them in command_line=\"…\"")
      ->type_name("NAME=VALUE");
  // One file each time, since the application and settings come after it.
  command.add_option("--config", arguments.configurations, "configuration file (XML), may be given several times")
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
  run.add_flag("--profile", arguments.is_profiled, "measures how long each module takes, and says so at the end");
  run.add_option("--log", arguments.log_file, "writes faults, warnings, changes and what modules say into a file")
      ->type_name("FILE");
  run.add_option("--crash-report", arguments.crash_file,
                 "where a crash is told besides (runnel_crash_PROCESS.txt); '': nowhere")
      ->type_name("FILE");
  run.add_flag_callback(
      "--no-control", [&arguments] { arguments.has_control = false; }, "no other process can look at it or change it");
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
  run.add_flag("--paused", arguments.is_paused, "simulated time stands still until 'runnel resume' or 'runnel step'");
  run.add_flag("--clear-stop", arguments.clears_stop,
               "begins without the STOP that an earlier run of the file left in force");
  run.add_flag("--single-thread", arguments.is_single_threaded,
               "the cycles of all threads one after the other in one: simulated time, in step with the real one");
  AddWhatAccompaniesARun(run, arguments);
  return run;
}

CLI::App& AddReplay(CLI::App& program, RunArguments& arguments) {
  CLI::App& replay =
      *program.add_subcommand("replay", "publishes what was recorded, into an application or for viewers alone");
  replay.add_option("--rate", arguments.speed, "1 is real time (usual), 0 as fast as it can")
      ->type_name("FACTOR")
      ->check(CheckSpeed);
  replay.add_flag("--paused", arguments.is_paused, "begins with a pause: 'runnel resume' or 'runnel step' go on");
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
      ->type_name("FILE.xml")
      ->transform(ApplicationFile);
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
  const auto read = ExtensionCatalogue::Read(PluginManager().search_path());
  const ExtensionCatalogue none;
  // Whatever is installed: the robot can be stopped.
  if (!read && (count < 2 || std::string_view(words[1]) != "stop")) {
    return Ends(Fail(read.error(), ExitCode::kBadInput));
  }
  const ExtensionCatalogue* const catalogue = read ? &*read : &none;
  CLI::App program("Runs robot applications that are described in XML files.", "runnel");
  program.require_subcommand(1);
  program.set_version_flag("--version", "runnel " RUNNEL_VERSION, "says which version this is");
  program.footer(FooterText());
  RunArguments run_arguments;
  RunArguments replay_arguments;
  CheckArguments check_arguments;
  ModulesArguments modules_arguments;
  SchemaArguments schema_arguments;
  GraphArguments graph_arguments;

  CLI::App& run = AddRun(program, run_arguments);
  const ExtensionCommandLine run_extensions(*catalogue, run);
  CLI::App& replay = AddReplay(program, replay_arguments);
  const ExtensionCommandLine replay_extensions(*catalogue, replay);
  AddReplayedApplication(replay, replay_arguments.application);
  CLI::App& check = *program.add_subcommand("check", "looks for mistakes, without running");
  AddApplicationArguments(check, check_arguments.application);
  check
      .add_option("--model", check_arguments.model_file,
                  "writes what is checked of a network of behaviours as a model for Spin (Promela)")
      ->type_name("FILE")
      ->check(CheckFile);
  CLI::App& modules = *program.add_subcommand("modules", "lists module types, ports, parameters");
  modules.add_option("plugins", modules_arguments.plugins, "only of these; without, of all")->type_name("PLUGIN");
  CLI::Option* const names = modules.add_flag("--names", modules_arguments.names_only, "only the names of the types");
  modules.add_flag("--json", modules_arguments.as_json, "all that is known of them, as JSON")->excludes(names);
  CLI::App& schema =
      *program.add_subcommand("schema", "writes the XML schema of application files, for editors and checkers");
  schema.add_option("plugins", schema_arguments.plugins, "only of these; without, of all")->type_name("PLUGIN");
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

  run.footer("For example: runnel run xml/apps/bug_demo.xml --inspect goal_x=4");
  replay.footer("For example: runnel replay run.mcap robot.xml --ports '/laser/*'");
  check.footer("For example: runnel check robot.xml");
  modules.footer("For example: runnel modules motion");
  schema.footer("For example: runnel schema -o runnel.xsd");
  graph.footer("For example: runnel graph robot.xml -o robot.svg");
  for (CLI::App* each : {&run, &replay, &check, &graph}) each->group("Applications");
  for (CLI::App* each : {&modules, &schema}) each->group("Modules");

  const std::vector<const char*> ordered = WithCommandFirst(count, words);
  count = static_cast<int>(ordered.size());
  words = ordered.data();
  const std::string command = count > 1 ? words[1] : "";
  const std::vector<std::string> all_commands = AllCommands(program);
  if (command == "complete" && count > 3 && std::string_view(words[2]) == "--all") {
    const CLI::App* const known = FindCommand(program, words[3]);
    return [=, names = all_commands, options = known != nullptr ? OptionNames(*known) : std::vector<std::string>(),
            typed = std::vector<std::string>(words + 3, words + count)] { return CompleteAll(typed, names, options); };
  }
  if (command == "help") {
    const std::string about = count > 2 ? words[2] : "";
    if (about.empty()) {
      std::cout << program.help();
      return Ends(ExitCode::kDone);
    }
    if (std::ranges::count(OtherCommands(), about) > 0) {
      std::array<char*, 3> other{const_cast<char*>(words[2]), const_cast<char*>("--help"), nullptr};
      return Refuse(BecomeProgram(about, other.data()), "see 'runnel help'");
    }
    const CLI::App* const known = FindCommand(program, about);
    if (known == nullptr) {
      return Refuse("there is no command '" + about + "'", NearestNameHint(about, all_commands));
    }
    std::cout << known->help("runnel");
    return Ends(ExitCode::kDone);
  }
  const bool is_known = std::ranges::count(all_commands, command) > 0;
  if (count > 1 && !command.starts_with('-') && !is_known) {
    if (const auto* const extension = catalogue->FindCommand(command)) {
      return Refuse("'" + command + "' is of the extension '" + extension->name + "', which is not installed",
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
    return RefuseParsing(program, error);
  }
  const std::string& file = run_arguments.application.file;
  if (run.parsed() && file.ends_with(".mcap")) {
    return Refuse(file + " is a recording, and no application", "play it by 'runnel replay " + file + "'");
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

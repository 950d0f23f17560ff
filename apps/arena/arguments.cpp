#include "apps/arena/arguments.h"

#include <algorithm>
#include <thread>

#include <CLI/CLI.hpp>

#include "apps/program.h"
#include "core/base/nearest_name.h"
#include "core/base/number_text.h"

namespace runnel::arena {

namespace {

void AddChoices(CLI::App& program, ArenaArguments& arguments) {
  program.add_option("--world", arguments.worlds, "world files, or names of those that come with Runnel")
      ->type_name("FILE")
      ->required();
  const auto add_list = [&](const char* name, auto& list, const char* what) {
    return program.add_option(name, list, what)
        ->type_name("LIST")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->capture_default_str();
  };
  add_list("--variant", arguments.variants,
           "planners: all, bug1 (planning/bug1), any module type with a '/', or an .xml file with a <module> tag");
  add_list("--sensor", arguments.sensors, "laser, infrared, bumper: what the applications there are for");
  add_list("--direction", arguments.directions, "first turn at an obstacle: left, right");
  add_list("--seed", arguments.seeds, "of the noise, and so of the run")
      ->transform(WholeNumber<std::uint64_t>("a seed"));
  add_list("--plugin", arguments.plugins, "loads others' plugins, whose planners can be variants");
}

void AddNumbers(CLI::App& program, ArenaArguments& arguments) {
  RunSettings& settings = arguments.settings;
  const auto add = [&](const char* name, double& value, const char* type, const char* what) {
    program.add_option(name, value, what)->type_name(type)->capture_default_str();
  };
  add("--noise", settings.noise, "M", "standard deviation of the ranges measured");
  add("--path-step", settings.path_step, "M", "between the points of a path that are kept");
  add("--safe-distance", settings.safe_distance, "M", "of the robot's centre from obstacles");
  add("--time-limit", settings.time_limit, "S", "of simulated time, for each run; 0: by the length of the walls");
  add("--wall-limit", arguments.wall_limit, "S",
      "of real time, for each run; one that takes longer hangs, and is ended");
  program.add_option("--jobs", arguments.jobs, "runs at the same time")
      ->type_name("N")
      ->transform(WholeNumber<int>("the number of jobs"))
      ->capture_default_str();
}

void AddShard(CLI::App& program, ArenaArguments& arguments) {
  const auto read = [&arguments](const std::string& text) {
    const std::size_t slash = text.find('/');
    const auto shard = NumberIn<std::size_t>(text.substr(0, slash));
    const auto shards = NumberIn<std::size_t>(slash == std::string::npos ? "" : text.substr(slash + 1));
    if (!shard || !shards || *shard < 1 || *shard > *shards) {
      throw CLI::ValidationError("--shard", "is I/N, with I from 1 to N, not '" + text + "'");
    }
    arguments.shard = *shard;
    arguments.shards = *shards;
  };
  program
      .add_option_function<std::string>(
          "--shard", read, "makes each N-th run only, beginning with number I: the parts of 1/N to N/N are all")
      ->type_name("I/N");
}

void AddOutputs(CLI::App& program, ArenaArguments& arguments) {
  program.add_option("--json", arguments.json, "writes all runs into this file")->type_name("FILE");
  program.add_option("--svg", arguments.svg, "draws a picture of each run in this folder")->type_name("DIR");
  program.add_option("--html", arguments.html, "writes a page with all paths and tables")->type_name("FILE");
  program.add_flag("--resume", arguments.resume,
                   "does not repeat runs that an earlier arena with the same --json has finished");
  program.add_flag("--quiet", arguments.quiet, "no progress, only the tables");
}

struct Range {
  double value, low, high;
  const char* fault;
};

std::string FaultOf(const ArenaArguments& arguments) {
  const RunSettings& settings = arguments.settings;
  const auto jobs = static_cast<double>(arguments.jobs);
  for (const auto& [value, low, high, fault] :
       {Range{jobs, 1, 1000, "--jobs must be between 1 and 1000"},
        Range{settings.noise, 0, 10, "--noise must be between 0 and 10 m"},
        Range{settings.path_step, 0, 1000, "--path-step must be between 0 and 1000 m"},
        // The robot's radius is 0.15 m.
        Range{settings.safe_distance, 0.16, 10, "--safe-distance must be between 0.16 and 10 m"},
        Range{settings.time_limit, 0, 1e6, "--time-limit must be between 0 and 1e6 s"},
        Range{arguments.wall_limit, 0.1, 1e6, "--wall-limit must be between 0.1 and 1e6 s"}}) {
    if (!(value >= low && value <= high)) return fault;  // also what is no number
  }
  if (arguments.resume && arguments.json.empty()) {
    return "--resume needs --json, to know what is finished";
  }
  return {};
}

}  // namespace

Result<ArenaArguments> ParseArguments(int count, const char* const* words) {
  CLI::App program("Compares planners over worlds, sensors, directions and seeds.", "runnel arena");
  program.footer(
      "Each run is a process of its own: one that crashes or hangs is a row of the table.\n"
      "'runnel arena merge INTO.json PART.json ...' puts the runs of several arenas (--shard) together.\n"
      "Exit codes: 0 all runs are finished, 1 interrupted, or a file could not be written, 2 bad input.");
  ArenaArguments arguments;
  arguments.jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  AddChoices(program, arguments);
  AddNumbers(program, arguments);
  AddShard(program, arguments);
  AddOutputs(program, arguments);
  try {
    program.parse(count, words);
  } catch (const CLI::Success& help) {
    program.exit(help);
    return Error{};
  } catch (const CLI::ParseError& error) {
    const std::vector<std::string> left = program.remaining();
    const auto unknown = std::ranges::find_if(left, [](const std::string& each) { return each.starts_with("--"); });
    if (unknown == left.end()) return Error{.message = error.what(), .hint = "see 'runnel arena --help'"};
    std::vector<std::string> names;
    for (const CLI::Option* each : program.get_options()) {
      for (const std::string& name : each->get_lnames()) names.push_back("--" + name);
    }
    const std::string option = unknown->substr(0, unknown->find('='));
    return Error{.message = "there is no option '" + option + "'", .hint = NearestNameHint(option, names)};
  }
  if (const std::string fault = FaultOf(arguments); !fault.empty()) return Error{.message = fault};
  return arguments;
}

}  // namespace runnel::arena

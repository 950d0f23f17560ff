#include "apps/world/world_command.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iostream>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/base/nearest_name.h"
#include "modules/simulation/world_file/world_file.h"

namespace runnel::world_program {

namespace {

struct NamedKind {
  std::string_view name;
  WorldKind kind;
};
constexpr std::array<NamedKind, 4> kKinds{{{"scatter", WorldKind::kScatter},
                                           {"maze", WorldKind::kMaze},
                                           {"spiral", WorldKind::kSpiral},
                                           {"comb", WorldKind::kComb}}};

Result<WorldKind> KindCalled(const std::string& name) {
  const auto found = std::ranges::find(kKinds, name, &NamedKind::name);
  if (found != kKinds.end()) return found->kind;
  return Error{.message = "there is no kind of world called '" + name + "'",
               .hint = NearestNameHint(name, NamesOf(kKinds, &NamedKind::name))};
}

/// Only what differs from the defaults.
std::string CommandOf(const GeneratorOptions& options) {
  const GeneratorOptions defaults;
  std::string command = "runnel world --kind ";
  command += std::ranges::find(kKinds, options.kind, &NamedKind::kind)->name;
  command += " --seed " + std::to_string(options.seed);
  const auto add = [&](const char* name, double value, double usual) {
    if (value != usual) command += fmt::format(" {} {}", name, value);
  };
  add("--width", options.width, defaults.width);
  add("--height", options.height, defaults.height);
  add("--gap", options.gap, defaults.gap);
  add("--count", options.count, defaults.count);
  return command + (options.is_enclosed ? " --enclosed" : "");
}

}  // namespace

Result<WorldArguments> ParseArguments(int count, const char* const* words) {
  CLI::App program("Makes a world from a seed: the same options, the same bytes.", "runnel world");
  WorldArguments arguments;
  GeneratorOptions& options = arguments.options;
  std::string kind;
  program.add_option("--kind", kind, "scatter, maze, spiral or comb")->required();
  program.add_option("--seed", options.seed, "of the random numbers")->capture_default_str();
  program.add_option("--out", arguments.file, "the file to write; without, standard output")
      ->type_name("FILE");
  program.add_option("--width", options.width, "m along x, of a scatter or maze")
      ->capture_default_str();
  program.add_option("--height", options.height, "m along y, of a scatter or maze")
      ->capture_default_str();
  program.add_option("--gap", options.gap, "m, of every passage at least")->capture_default_str();
  program.add_option("--count", options.count,
                     "shapes of a scatter, teeth of a comb, turns of a spiral; 0: by the seed");
  program.add_flag("--enclosed", options.is_enclosed, "walls the goal in: it cannot be reached");
  try {
    program.parse(count, words);
  } catch (const CLI::Success& help) {
    program.exit(help);
    return Error{};
  } catch (const CLI::ParseError& error) {
    return Error{.message = error.what(), .hint = "see 'runnel world --help'"};
  }
  const auto found = KindCalled(kind);
  if (!found) return found.error();
  options.kind = *found;
  if (const std::string fault = FaultOf(options); !fault.empty()) return Error{.message = fault};
  return arguments;
}

std::string WorldText(const GeneratorOptions& options) {
  return "<!-- Made by: " + CommandOf(options) + " -->\n" + WriteWorld(GenerateWorld(options));
}

Result<void> WriteGeneratedWorld(const WorldArguments& arguments) {
  const std::string text = WorldText(arguments.options);
  if (arguments.file.empty()) {
    std::cout << text << std::flush;
    if (std::cout) return {};
    return Error{.message = "standard output could not be written"};
  }
  std::ofstream file(arguments.file, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  if (file) return {};
  return Error{.message = "the world cannot be written",
               .position = {arguments.file},
               .hint = "is its folder there, and may you write in it?"};
}

}  // namespace runnel::world_program

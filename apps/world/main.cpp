// The command `runnel world`: makes a world from a seed.

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/program.h"
#include "core/base/nearest_name.h"
#include "modules/simulation/world_file/world_file.h"
#include "modules/worlds/algorithm/world_generator.h"

namespace runnel {

namespace {

Result<WorldKind> KindCalled(const std::string& name) {
  const auto found = std::ranges::find(kWorldKindNames, name);
  if (found != kWorldKindNames.end()) return static_cast<WorldKind>(found - kWorldKindNames.begin());
  return Error{.message = "there is no kind of world called '" + name + "'",
               .hint = NearestNameHint(name, std::vector<std::string>(kWorldKindNames.begin(), kWorldKindNames.end()))};
}

/// Only what differs from the defaults. A comment must not have "--" in it.
std::string OriginOf(const GeneratorOptions& options) {
  const GeneratorOptions defaults;
  std::string origin = "<!-- Made by runnel world: kind ";
  origin += kWorldKindNames[static_cast<std::size_t>(options.kind)];
  origin += ", seed " + std::to_string(options.seed);
  const auto add = [&](const char* name, double value, double usual) {
    if (value != usual) origin += fmt::format(", {} {}", name, value);
  };
  add("width", options.width, defaults.width);
  add("height", options.height, defaults.height);
  add("gap", options.gap, defaults.gap);
  add("count", options.count, defaults.count);
  return origin + (options.is_enclosed ? ", enclosed" : "") + " -->\n";
}

/// Makes it, headed by a comment that says how it was made; file "": to standard output.
int Make(GeneratorOptions& options, const std::string& kind, const std::string& file) {
  const auto found = KindCalled(kind);
  if (!found) return Fail(found.error());
  options.kind = *found;
  if (const std::string fault = FaultOf(options); !fault.empty()) return Fail({.message = fault});
  return WriteText(OriginOf(options) + WriteWorld(GenerateWorld(options)), file);
}

}  // namespace

}  // namespace runnel

int main(int count, char** words) {
  CLI::App program("Makes a world from a seed: the same options, the same bytes.", "runnel world");
  runnel::GeneratorOptions options;
  std::string kind, file;
  program.add_option("--kind", kind, "scatter, maze, spiral, comb or ring")->required();
  program.add_option("--seed", options.seed, "of the random numbers")
      ->transform(runnel::WholeNumber<std::uint64_t>("a seed"))
      ->capture_default_str();
  program.add_option("--out", file, "the file to write; without, standard output")->type_name("FILE");
  program.add_option("--width", options.width, "m along x, of a scatter or maze; of rings twice the way to the goal")
      ->capture_default_str();
  program.add_option("--height", options.height, "m along y, of a scatter or maze")->capture_default_str();
  program.add_option("--gap", options.gap, "m, of every passage at least")->capture_default_str();
  program
      .add_option("--count", options.count,
                  "shapes of a scatter, teeth of a comb, turns of a spiral, rings; 0: by the seed")
      ->transform(runnel::WholeNumber<int>("a count"));
  program.add_flag("--enclosed", options.is_enclosed, "walls the goal in: it cannot be reached");
  return runnel::RunProgram(program, count, words, [&] { return runnel::Make(options, kind, file); });
}

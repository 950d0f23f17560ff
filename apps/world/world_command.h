#pragma once

#include <string>

#include "core/base/result.h"
#include "modules/worlds/algorithm/world_generator.h"

namespace runnel::world_program {

struct WorldArguments {
  GeneratorOptions options;
  std::string file = {};  ///< "": standard output
};

/// Errors: a kind that there is not, numbers out of their ranges, and what the command line parser
/// says. An empty message: nothing is left to do, help has been printed.
[[nodiscard]] Result<WorldArguments> ParseArguments(int count, const char* const* words);

/// The file, headed by a comment that says how it was made.
[[nodiscard]] std::string WorldText(const GeneratorOptions& options);

/// Errors: the file cannot be written.
Result<void> WriteGeneratedWorld(const WorldArguments& arguments);

}  // namespace runnel::world_program

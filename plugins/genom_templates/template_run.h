#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "plugins/genom_templates/generated_files.h"

namespace runnel::genom {

struct TemplateOutput {
  std::vector<GeneratedFile> files = {};
  std::vector<std::string> sources = {};  ///< all that was read of the template
};

/// What a template may use up until it is ended with an error: far more than any that comes to an end by itself.
struct TemplateLimits {
  std::uint64_t steps = 2'000'000'000;  ///< of Lua's machine
  std::size_t bytes = std::size_t{2} << 30U;
};

/// Runs template.lua of the folder, which says what files are made from what; nothing is written. `model` is the
/// description as JSON; `options` are what was said to the template on the command line.
///
/// Threads: any; each run is its own. Errors: with file and line of the template, but for what it tells by fail().
[[nodiscard]] Result<TemplateOutput> RunTemplate(const std::filesystem::path& folder, const std::string& model,
                                                 const std::map<std::string, std::string>& options,
                                                 const TemplateLimits& limits = {});

}  // namespace runnel::genom

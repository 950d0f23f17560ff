#pragma once

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

/// Runs template.lua of the folder, which says what files are made from what; nothing is written. `model` is the
/// description as JSON; `options` are what was said to the template on the command line.
///
/// Threads: any; each run is its own. Errors: with file and line of the template.
[[nodiscard]] Result<TemplateOutput> RunTemplate(const std::filesystem::path& folder, const std::string& model,
                                                 const std::map<std::string, std::string>& options);

}  // namespace runnel::genom

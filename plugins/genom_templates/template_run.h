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

/// A template's text as a program in Lua that writes it: what stands in `<% … %>` is run, what stands in `<%= … %>` is
/// computed and written. A line that holds nothing but scripts leaves no line. Each line of the program is that line of
/// the template, so that places in Lua's messages are right.
///
/// Errors: a marker without its other half; the position has line and column, and no file.
[[nodiscard]] Result<std::string> ProgramOf(const std::string& text);

/// The folder of a template: one that is named by its path, or one of the name in a folder of RUNNEL_GENOM_TEMPLATES, or one
/// that comes with Runnel. Errors: none has a file template.lua; the nearest name is told.
[[nodiscard]] Result<std::filesystem::path> FindTemplate(const std::string& name);

/// Where the templates that come with Runnel are: share/runnel/genom_templates beside the folder of this program.
[[nodiscard]] std::filesystem::path TemplatesOfRunnel();

/// The names of all that can be found, sorted.
[[nodiscard]] std::vector<std::string> TemplateNames();

}  // namespace runnel::genom

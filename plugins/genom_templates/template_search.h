#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace runnel::genom {

/// The folder of a template: one that is named by its path, or one of the name in a folder of RUNNEL_GENOM_TEMPLATES, or one
/// that comes with Runnel. Errors: none has a file template.lua; the nearest name is told.
[[nodiscard]] Result<std::filesystem::path> FindTemplate(const std::string& name);

/// Where the templates that come with Runnel are: share/runnel/genom_templates beside the folder of this program.
[[nodiscard]] std::filesystem::path TemplatesOfRunnel();

/// The names of all that can be found, sorted.
[[nodiscard]] std::vector<std::string> TemplateNames();

}  // namespace runnel::genom

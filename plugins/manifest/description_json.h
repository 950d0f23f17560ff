#pragma once

#include <string>
#include <vector>

#include "plugins/manifest/module_description.h"

namespace runnel {

/// Module types as JSON, for programs: a list of {"type", "summary", "plugin", "problem", "ports": [{"name", "group",
/// "direction", "type", "required", "description"}], "parameters": [{"name", "type", "unit", "default", "minimum",
/// "maximum", "choices", "static", "description"}]}; null for what there is none of.
[[nodiscard]] std::string JsonText(const std::vector<ModuleDescription>& modules);

/// One of them.
void AppendJson(const ModuleDescription& module, std::string& json);

}  // namespace runnel

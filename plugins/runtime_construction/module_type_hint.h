#pragma once

#include <string>
#include <string_view>

#include "core/plugin/plugin_manager.h"

namespace runnel {

/// What to do about a module type that is not known: load the plugin that it is named after, write
/// the type that comes nearest, or find out where it comes from.
[[nodiscard]] std::string ModuleTypeHint(std::string_view type, const PluginManager& plugins);

}  // namespace runnel

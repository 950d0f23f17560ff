#pragma once

#include <string_view>

#include "core/plugin/plugin_manager.h"
#include "plugins/runtime_construction/xml_tag.h"

namespace runnel {

/// Loads a plugin that may add tags: what it adds counts as its own.
Result<void> LoadPlugin(std::string_view plugin, PluginManager& plugins, XmlTagRegistry& tags);

}  // namespace runnel

#pragma once

#include <memory>
#include <string>

#include "core/plugin/plugin_manager.h"
#include "plugins/wire/wire_engines.h"

namespace runnel {

/// The engine of this name, "cyclone" for the plugin wire_cyclone, loaded if need be. Errors: it is not installed.
/// Threads: as the plugin manager.
[[nodiscard]] Result<std::shared_ptr<WireEngine>> FindWireEngine(const std::string& name, PluginManager& plugins);
/// For tests, which have no network.
void AddWireEngine(const std::string& name, std::shared_ptr<WireEngine> engine);

}  // namespace runnel

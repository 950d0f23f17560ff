#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/plugin/plugin_manager.h"

namespace runnel {

// The types of modules and of ports' values that a file may name.

[[nodiscard]] std::vector<std::string> ModuleTypeNames(const PluginManager& plugins);
/// Of those that are known so far.
[[nodiscard]] std::vector<std::string> PortTypeNames();

/// Errors: there is no such module type, with the cure: a plugin to be loaded, the nearest name, or the
/// types that end alike.
[[nodiscard]] Result<void> CheckModuleType(std::string_view type, const PluginManager& plugins);

/// Types become known when something uses them first. This makes one module of each kind, away from any application, and
/// throws it away again: then the types of all their ports are known, and the built-in ones.
///
/// Threads: starts one for that time, since the caller holds the lock of its own runtime.
void MakePortTypesKnown(const PluginManager& plugins);

/// If this one is not known, all are made known. Errors: no such type, with the nearest.
///
/// Threads: as MakePortTypesKnown().
[[nodiscard]] Result<void> CheckPortType(std::string_view type, const PluginManager& plugins);

}  // namespace runnel

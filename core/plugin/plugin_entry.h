#pragma once

#include <cstdint>

#include "core/plugin/abi.h"
#include "core/plugin/plugin_registry.h"

namespace runnel {

/// What a plugin library exports. Plain data, so that it can be read before any C++ class of the
/// library is trusted. The first two members never change their place.
struct PluginEntry {
  std::uint32_t abi_version;
  std::uint32_t entry_size;  ///< sizeof(PluginEntry) as the plugin was built
  const char* fingerprint;   ///< kAbiFingerprint as the plugin was built
  const char* name;
  void (*register_plugin)(PluginRegistry&);
};

/// The name of the exported function, of type `const PluginEntry* ()`.
inline constexpr const char* kPluginEntrySymbol = "RunnelPluginEntry";

}  // namespace runnel

/// Defines the entry of a plugin library. Use it exactly once per library, in a .cpp file:
///
///     RUNNEL_PLUGIN(motion, registry) {
///       registry.Add<runnel::motion::CollisionGuard>("motion/collision_guard", "stops before
///       walls");
///     }
///
/// The function runs once, while the library is being loaded, on the loading thread. Exceptions
/// that it throws are reported as a failure to load the library, and nothing stays registered.
#define RUNNEL_PLUGIN(plugin_name, registry)                                                                          \
  static void RunnelRegister_##plugin_name(::runnel::PluginRegistry& registry);                                       \
  extern "C" __attribute__((visibility("default"))) const ::runnel::PluginEntry* RunnelPluginEntry() {                \
    static const ::runnel::PluginEntry entry{::runnel::kPluginAbiVersion, sizeof(::runnel::PluginEntry),              \
                                             ::runnel::kAbiFingerprint, #plugin_name, &RunnelRegister_##plugin_name}; \
    return &entry;                                                                                                    \
  }                                                                                                                   \
  static void RunnelRegister_##plugin_name([[maybe_unused]] ::runnel::PluginRegistry& registry)

#include "core/plugin/plugin_entry.h"

extern "C" __attribute__((visibility("default"))) const runnel::PluginEntry* RunnelPluginEntry() {
  // Never called: the handshake fails.
  static const runnel::PluginEntry entry{runnel::kPluginAbiVersion + 1, sizeof(runnel::PluginEntry),
                                         runnel::kAbiFingerprint, "other_abi_version", nullptr};
  return &entry;
}

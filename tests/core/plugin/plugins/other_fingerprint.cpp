#include "core/plugin/plugin_entry.h"

extern "C" __attribute__((visibility("default"))) const runnel::PluginEntry* RunnelPluginEntry() {
  // Never called: the handshake fails.
  static const runnel::PluginEntry entry{runnel::kPluginAbiVersion, sizeof(runnel::PluginEntry), "some other compiler",
                                         "other_fingerprint", nullptr};
  return &entry;
}

// Built with the other mode of the standard library than the core, whichever that has.

#ifdef _GLIBCXX_DEBUG
#undef _GLIBCXX_DEBUG
#else
#define _GLIBCXX_DEBUG
#endif

#include "core/plugin/plugin_entry.h"

extern "C" __attribute__((visibility("default"))) const runnel::PluginEntry* RunnelPluginEntry() {
  // Never called: the handshake fails.
  static const runnel::PluginEntry entry{runnel::kPluginAbiVersion, sizeof(runnel::PluginEntry),
                                         runnel::kAbiFingerprint, "other_library_mode", nullptr};
  return &entry;
}

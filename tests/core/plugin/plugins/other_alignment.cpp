// Built, as far as its fingerprint can tell, for other vector instructions than the core.

#ifdef __AVX__
#undef __AVX__
#undef __AVX512F__
#else
#define __AVX__ 1
#endif

#include "core/plugin/plugin_entry.h"

extern "C" __attribute__((visibility("default"))) const runnel::PluginEntry* RunnelPluginEntry() {
  // Never called: the handshake fails.
  static const runnel::PluginEntry entry{runnel::kPluginAbiVersion, sizeof(runnel::PluginEntry),
                                         runnel::kAbiFingerprint, "other_alignment", nullptr};
  return &entry;
}

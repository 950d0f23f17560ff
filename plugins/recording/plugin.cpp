#include "core/plugin/plugin_entry.h"
#include "plugins/recording/recorder_module.h"

RUNNEL_PLUGIN(recording, registry) {
  registry.Add<runnel::RecorderModule>("recording/recorder",
                                       "records what ports publish into an MCAP file");
}

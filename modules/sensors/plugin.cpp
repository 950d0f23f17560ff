#include "core/plugin/plugin_entry.h"
#include "modules/sensors/scan_filter.h"

RUNNEL_PLUGIN(sensors, registry) {
  registry.Add<runnel::ScanFilter>("sensors/scan_filter", "takes single wrong rays out of laser scans");
}

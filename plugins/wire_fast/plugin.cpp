#include "core/plugin/plugin_entry.h"
#include "plugins/wire/wire_engines.h"
#include "plugins/wire_fast/fast_wire.h"

RUNNEL_PLUGIN(wire_fast, registry) {
  if (auto* const engines = registry.Find<runnel::WireEngines>()) engines->Add(runnel::MakeFastWire());
}

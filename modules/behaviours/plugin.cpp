#include "core/plugin/plugin_entry.h"
#include "modules/behaviours/fusion.h"

RUNNEL_PLUGIN(behaviours, registry) {
  using namespace runnel;
  RegisterMetaSignals();
  registry.Add<FusionBehaviour>("behaviours/fusion", "makes what several behaviours want one");
}

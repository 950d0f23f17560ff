#include "core/plugin/plugin_entry.h"
#include "tests/core/plugin/plugins/idle.h"

extern "C" int Needed();

RUNNEL_PLUGIN(needing, registry) {
  registry.Add<runnel::test::Idle>("needing/version_" + std::to_string(Needed()), "");
}

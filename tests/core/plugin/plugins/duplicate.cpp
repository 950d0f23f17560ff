#include "tests/core/plugin/plugins/idle.h"

RUNNEL_PLUGIN(duplicate, registry) {
  registry.Add<runnel::test::Idle>("duplicate/idle", "is taken back");
  registry.Add<runnel::test::Idle>("good/counter", "belongs to another plugin");
}

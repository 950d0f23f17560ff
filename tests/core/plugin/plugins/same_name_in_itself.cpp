#include "tests/core/plugin/plugins/idle.h"

RUNNEL_PLUGIN(same_name_in_itself, registry) {
  registry.Add<runnel::test::Idle>("twice/idle", "first");
  registry.Add<runnel::test::Idle>("twice/idle", "second");
}

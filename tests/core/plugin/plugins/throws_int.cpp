#include "tests/core/plugin/plugins/idle.h"

RUNNEL_PLUGIN(throws_int, registry) {
  registry.Add<runnel::test::Idle>("throws_int/idle", "is taken back");
  throw 7;
}

#include <stdexcept>

#include "tests/core/plugin/plugins/idle.h"
#include "tests/core/plugin/tag_registry.h"

RUNNEL_PLUGIN(throws, registry) {
  registry.Add<runnel::test::Idle>("throws/idle", "is taken back");
  if (auto* tags = registry.Find<runnel::test::TagRegistry>()) {
    tags->Add("throws", registry.plugin());
  }
  throw std::runtime_error("no driver");
}

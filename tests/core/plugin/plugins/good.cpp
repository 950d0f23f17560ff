#include "core/module/module.h"
#include "core/plugin/plugin_entry.h"
#include "core/port/output.h"
#include "tests/core/plugin/tag_registry.h"

namespace runnel::test {
namespace {

class Counter final : public Module {
 public:
  using Module::Module;
  Output<int> count{this, "count"};

 private:
  void Update() override { count.Publish(++count_); }
  int count_ = 0;
};

class Broken final : public Module {
 public:
  explicit Broken(const Placement& placement) : Module(placement) { throw std::runtime_error("the device is missing"); }

 private:
  void Update() override {}
};

}  // namespace
}  // namespace runnel::test

RUNNEL_PLUGIN(good, registry) {
  registry.Add<runnel::test::Counter>("good/counter", "counts");
  registry.Add<runnel::test::Broken>("good/broken", "cannot be made");
  if (auto* tags = registry.Find<runnel::test::TagRegistry>()) tags->Add("good", registry.plugin());
}

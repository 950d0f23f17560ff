// A plugin for tests: a module that hands on what a planner needs, and fails after a while.

#include <stdexcept>

#include "core/module/module.h"
#include "core/plugin/plugin_entry.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "modules/types/surroundings.h"
#include "plugins/parameters/parameter.h"

namespace runnel {

class FaultyRelay final : public Module {
 public:
  using Module::Module;

  Input<Surroundings> in{this, "in", {.required = true}};
  Output<Surroundings> out{this, "out"};
  Parameter<std::uint32_t> good_cycles{this, "good_cycles", {.default_value = 100}};

 private:
  void Update() override {
    if (++cycles_ > good_cycles.Get()) throw std::runtime_error("the relay is worn out");
    if (const auto view = in.Read(); view.is_new()) out.Publish(*view);
  }

  std::uint32_t cycles_ = 0;
};

}  // namespace runnel

RUNNEL_PLUGIN(faulty, registry) {
  registry.Add<runnel::FaultyRelay>("faulty/relay", "hands on, and fails after a while");
}

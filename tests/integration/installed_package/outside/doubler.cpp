#include "core/module/module.h"
#include "core/plugin/plugin_entry.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "plugins/parameters/parameter.h"

namespace outside {

class Doubler final : public runnel::Module {
 public:
  using Module::Module;

  runnel::Input<double> value{this, "value"};
  runnel::Output<double> doubled{this, "doubled"};
  runnel::Parameter<double> factor{this, "factor", {.default_value = 2, .bounds = {-10, 10}}};

 private:
  void Update() override {
    const auto read = value.Read();
    doubled.Publish(factor.Get() * read.value_or(1));
  }
};

}  // namespace outside

RUNNEL_PLUGIN(outside, registry) {
  registry.Add<outside::Doubler>("outside/doubler", "twice the value");
}

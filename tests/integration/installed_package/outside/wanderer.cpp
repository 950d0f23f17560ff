#include <algorithm>

#include <runnel/module.h>
#include <runnel/plugin.h>
#include <runnel/types.h>

using namespace runnel;

/// Drives ahead, and turns where something is near.
class Wanderer final : public Module {
 public:
  using Module::Module;

  Input<RangeScan> scan{this, "scan", {.required = true}};
  Output<Twist2> twist{this, "twist"};
  Parameter<double> distance{this, "distance", {.default_value = 0.6, .bounds = {0.2, 3.0}, .unit = "m"}};

 private:
  void Update() override {
    const auto seen = scan.Read();
    if (!seen.is_new()) return;
    const float nearest = *std::ranges::min_element(seen->ranges);
    twist.Publish(nearest > distance.Get() ? Twist2{.forward = 0.4} : Twist2{.turn = 1.0});
  }
};

RUNNEL_PLUGIN(outside, registry) {
  registry.Add<Wanderer>("outside/wanderer", "drives ahead, turns where something is near");
}

// What is smoothed and moves nothing by itself begins where it was measured, and goes on under a STOP.

#include <gmock/gmock.h>

#include "core/module/group.h"
#include "modules/signal/filters.h"
#include "plugins/testing/module_rig.h"
#include "tests/modules/signal/filled.h"

namespace runnel::signal {
namespace {

using test::ModuleRig;
using ::testing::DoubleNear;
using namespace std::chrono_literals;

// As a module of Python has it, or one in C++ that says nothing.
template <Ageing kAgeing>
struct KeepDistance final : Module {
  using Module::Module;
  Input<double> distance{this, "distance", {.ageing = kAgeing}};
  Output<double> speed{this, "speed", {.unit = "m/s"}};
  void Update() override {}
};
template <Ageing kAgeing>
void SmoothedDistanceIsNoVelocity() {
  ModuleRig<LowPassFilter> rig(10ms);
  ASSERT_TRUE(rig.Prepare());
  auto& keep = rig.runtime.Create<KeepDistance<kAgeing>>(rig.runtime.root(), "keep");
  auto& others = rig.runtime.Create<Group>(rig.runtime.root(), "others");
  Input<double> wheels(others, "wheels", {.unit = "m/s", .drives = true});
  ASSERT_TRUE(Port::Connect(keep.speed, wheels));
  ASSERT_TRUE(Port::Connect(rig.module.out, keep.distance));
  const auto measure = [&] {
    rig.Feed(rig.module.in, 2.0);
    rig.RunCycle();
    return rig.Last(rig.module.out);
  };
  EXPECT_EQ(measure(), 2);
  rig.runtime.robot_stop().Press("a test");
  EXPECT_EQ(measure(), 2);
  ASSERT_TRUE(rig.runtime.robot_stop().Release("a test"));
  EXPECT_EQ(measure(), 2);
  ASSERT_TRUE(wheels.PublishByHand(Filled(0.0)));
  EXPECT_EQ(measure(), 2);
  ASSERT_TRUE(wheels.Release());
  EXPECT_EQ(measure(), 2);
  wheels.DisconnectAll();
  keep.distance.DisconnectAll();
}
TEST(SmoothedMeasurement, OfADistanceIsNoVelocityWhereItTimesOut) { SmoothedDistanceIsNoVelocity<Ageing::kTimesOut>(); }
TEST(SmoothedMeasurement, OfADistanceIsNoVelocityWhereNothingIsSaid) {
  SmoothedDistanceIsNoVelocity<Ageing::kUnspecified>();
}

struct KeepSpeed final : Module {
  using Module::Module;
  Input<double> measured{this, "measured", {.unit = "m/s", .ageing = Ageing::kTimesOut}};
  Output<double> speed{this, "speed", {.unit = "m/s"}};
  void Update() override {}
};
TEST(SmoothedMeasurement, OfASpeedIsShownWhileStopIsInForce) {
  ModuleRig<LowPassFilter> rig(10ms);
  ASSERT_TRUE(rig.Prepare());
  auto& keep = rig.runtime.Create<KeepSpeed>(rig.runtime.root(), "keep");
  auto& others = rig.runtime.Create<Group>(rig.runtime.root(), "others");
  Input<double> wheels(others, "wheels", {.unit = "m/s", .drives = true});
  ASSERT_TRUE(Port::Connect(keep.speed, wheels));
  ASSERT_TRUE(Port::Connect(rig.module.out, keep.measured));
  rig.runtime.robot_stop().Press("a test");
  for (int i = 0; i < 100; ++i) {
    rig.Feed(rig.module.in, 2.0);
    rig.RunCycle();
  }
  EXPECT_THAT(rig.Last(rig.module.out), DoubleNear(2, 0.1)) << "it rolls on at 2 m/s";
  wheels.DisconnectAll();
  keep.measured.DisconnectAll();
}

}  // namespace
}  // namespace runnel::signal

// What counts when a value by hand ends, wherever what drives is marked and held, and whatever is made of it.

#include <gmock/gmock.h>

#include "core/module/group.h"
#include "core/port/proxy_port.h"
#include "core/types/type_of.h"
#include "modules/signal/filters.h"
#include "plugins/testing/module_rig.h"
#include "tests/modules/signal/filled.h"

namespace runnel::signal {
namespace {

using test::ModuleRig;
using ::testing::DoubleNear;
using namespace std::chrono_literals;

struct Car {
  double speed = 0;
  double steering = 0;
};
void Describe(TypeBuilder<Car>& type) {
  type.Name("Car").Field("speed", &Car::speed, {.unit = "m/s"}).Field("steering", &Car::steering, {.unit = "rad"});
}

/// A ramp, an interface port, and wheels: one of them is marked.
class MarkedWheels : public ::testing::Test {
 protected:
  MarkedWheels() {
    EXPECT_TRUE(rig.Prepare());
    EXPECT_TRUE(Port::Connect(rig.module.out, border));
    EXPECT_TRUE(Port::Connect(border, wheels));
  }
  ~MarkedWheels() override {
    wheels.DisconnectAll();
    border.DisconnectAll();
  }
  void Wish(double value) {
    rig.Feed(rig.module.in, value);
    rig.RunCycle();
  }

  ModuleRig<RateLimiterFilter> rig{100ms};
  Group& others = rig.runtime.Create<Group>(rig.runtime.root(), "others");
  ProxyPort& border = rig.runtime.Create<ProxyPort>(others, "border", Port::Direction::kInput, TypeOf<double>());
  Input<double> wheels{others, "wheels", {.unit = "m/s"}};
};

TEST_F(MarkedWheels, WhatARampHasMadeMeanwhileMovesNothingWhereverItIsHeld) {
  Port* const ports[] = {&rig.module.out, &border, &wheels};
  for (Port* const marked : ports) {
    ASSERT_TRUE(marked->SetDriving(true, AnyValue(0.0), {}, DrivingKind::kVelocity));
    for (Port* const held : ports) {
      for (const auto setter : {Port::Setter::kPerson, Port::Setter::kRule}) {
        ASSERT_TRUE(held->PublishByHand(Filled(0.0), setter));
        for (int i = 0; i < 20; ++i) Wish(1);
        ASSERT_TRUE(held->Release(setter));
        EXPECT_EQ(wheels.Get(), 0) << "marked " << marked->path() << ", held " << held->path();
        Wish(1);
        Wish(1);
        EXPECT_THAT(wheels.Get(), DoubleNear(0.2, 1e-9));
      }
    }
    ASSERT_TRUE(marked->SetDriving(false, AnyValue(0.0)));
  }
}

TEST_F(MarkedWheels, WhatWasSaidBeforeAPersonHeldWhatIsMarkedMovesNothing) {
  border.DisconnectAll();
  Output<double> planner(others, "planner");
  ASSERT_TRUE(Port::Connect(planner, border));
  ASSERT_TRUE(Port::Connect(border, wheels));
  Port* const ports[] = {&planner, &border, &wheels};
  for (Port* const marked : ports) {
    ASSERT_TRUE(marked->SetDriving(true, AnyValue(0.0), {}, DrivingKind::kVelocity));
    for (Port* const held : ports) {
      rig.Wait(1ms);
      planner.Publish(1);
      ASSERT_EQ(wheels.Get(), 1);
      ASSERT_TRUE(held->PublishByHand(Filled(0.0)));
      rig.Wait(10s);
      ASSERT_TRUE(held->Release());
      EXPECT_EQ(wheels.Get(), 0) << "marked " << marked->path() << ", held " << held->path();
    }
    ASSERT_TRUE(marked->SetDriving(false, AnyValue(0.0)));
  }
  planner.DisconnectAll();
}

TEST(MarkedCar, IsAVelocityAlsoWithAnAngleBesideIt) {
  ModuleRig<RateLimiterFilter> rig(100ms);
  ASSERT_TRUE(rig.Prepare());
  auto& others = rig.runtime.Create<Group>(rig.runtime.root(), "others");
  Output<Car> planner(others, "planner");
  Input<Car> car(others, "car");
  ASSERT_TRUE(car.SetDriving(true, AnyValue(TypeOf<Car>(), std::make_shared<const Car>())));
  ASSERT_TRUE(Port::Connect(planner, car));
  planner.Publish({1, 0.1});
  ASSERT_TRUE(
      car.PublishByHand([](void* value) -> Result<void> { return *static_cast<Car*>(value) = {}, Result<void>(); }));
  rig.Wait(10s);
  ASSERT_TRUE(car.Release());
  EXPECT_EQ(car.Get().speed, 0);
  car.DisconnectAll();
}

struct Joint {
  double angle = 0;
  double speed = 0;
};
void Describe(TypeBuilder<Joint>& type) {
  type.Name("Joint").Field("angle", &Joint::angle, {.unit = "rad"}).Field("speed", &Joint::speed, {.unit = "rad/s"});
}

TEST(MarkedJoint, IsAPositionAlsoWithItsSpeedBesideIt) {
  ModuleRig<RateLimiterFilter> rig(100ms);
  ASSERT_TRUE(rig.Prepare());
  auto& others = rig.runtime.Create<Group>(rig.runtime.root(), "others");
  Output<Joint> planner(others, "planner");
  Input<Joint> joint(others, "joint");
  ASSERT_TRUE(joint.SetDriving(true, AnyValue(TypeOf<Joint>(), std::make_shared<const Joint>())));
  ASSERT_TRUE(Port::Connect(planner, joint));
  planner.Publish({1.2, 0});
  ASSERT_TRUE(joint.PublishByHand([](void* value) -> Result<void> {
    return *static_cast<Joint*>(value) = {1.2, 0}, Result<void>();
  }));
  rig.Wait(1s);
  ASSERT_TRUE(joint.Release());
  EXPECT_EQ(joint.Get().angle, 1.2);
  joint.DisconnectAll();
}

// As in a fusion, or in a gate of one's own.
TEST(RampBeforeWhatLooksHowOldItIs, BeginsFromAStandstill) {
  struct Guard final : Module {
    using Module::Module;
    Input<double> in{this, "in", {.unit = "m/s", .ageing = Ageing::kTimesOut}};
    Output<double> out{this, "out", {.unit = "m/s"}};
    void Update() override {}
  };
  ModuleRig<RateLimiterFilter> rig(100ms);
  ASSERT_TRUE(rig.Prepare());
  auto& guard = rig.runtime.Create<Guard>(rig.runtime.root(), "guard");
  auto& others = rig.runtime.Create<Group>(rig.runtime.root(), "others");
  Input<double> wheels(others, "wheels", {.unit = "m/s", .drives = true});
  ASSERT_TRUE(Port::Connect(guard.out, wheels));
  ASSERT_TRUE(Port::Connect(rig.module.out, guard.in));
  EXPECT_NE(rig.module.out.motion_beginnings(), 0);
  wheels.DisconnectAll();
  guard.in.DisconnectAll();
}

// It is smoothed, and moves nothing by itself.
TEST(LowPassOfAMeasurement, GoesOnUnderAStop) {
  struct Controller final : Module {
    using Module::Module;
    Input<double> measured{this, "measured", {.unit = "rad"}};
    Output<double> torque{this, "torque", {.unit = "N*m"}};
    void Update() override {}
  };
  ModuleRig<LowPassFilter> rig(10ms);
  ASSERT_TRUE(rig.Prepare());
  auto& controller = rig.runtime.Create<Controller>(rig.runtime.root(), "controller");
  auto& others = rig.runtime.Create<Group>(rig.runtime.root(), "others");
  Input<double> motor(others, "motor", {.unit = "N*m", .drives = true, .safe_value = AnyValue(0.0)});
  ASSERT_TRUE(Port::Connect(controller.torque, motor));
  ASSERT_TRUE(Port::Connect(rig.module.out, controller.measured));
  const auto measure = [&] {
    rig.Feed(rig.module.in, 2.0);
    rig.RunCycle();
    return rig.Last(rig.module.out);
  };
  ASSERT_EQ(measure(), 2);
  rig.runtime.robot_stop().Press("a test");
  EXPECT_EQ(measure(), 2);
  ASSERT_TRUE(rig.runtime.robot_stop().Release("a test"));
  EXPECT_EQ(measure(), 2);
  rig.Wait(1s);
  EXPECT_EQ(measure(), 2);
  motor.DisconnectAll();
  controller.measured.DisconnectAll();
}

}  // namespace
}  // namespace runnel::signal

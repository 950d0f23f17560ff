// What counts as a velocity or a place when STOP, or a value by hand, ends.

#include <array>

#include <gmock/gmock.h>

#include "core/module/group.h"
#include "core/port/probe_port.h"
#include "core/port/proxy_port.h"
#include "core/types/builtin_types.h"
#include "core/types/type_of.h"
#include "modules/signal/filters.h"
#include "modules/types/pose.h"
#include "plugins/testing/module_rig.h"
#include "tests/modules/signal/filled.h"

namespace runnel::signal {
namespace {

using test::ModuleRig;
using ::testing::DoubleNear;
using namespace std::chrono_literals;

struct Ackermann {
  double steering_angle = 0, steering_angle_velocity = 0, speed = 0;
};
void Describe(TypeBuilder<Ackermann>& type) {
  type.Name("Ackermann")
      .Field("steering_angle", &Ackermann::steering_angle, {.unit = "rad"})
      .Field("steering_angle_velocity", &Ackermann::steering_angle_velocity, {.unit = "rad/s"})
      .Field("speed", &Ackermann::speed, {.unit = "m/s"});
}
struct Place {
  double x = 0;
};
void Describe(TypeBuilder<Place>& type) { type.Name("Place").Field("x", &Place::x, {.unit = "m"}); }
struct Speed {
  double x = 0;
};
void Describe(TypeBuilder<Speed>& type) { type.Name("Speed").Field("x", &Speed::x, {.unit = "m/s"}); }
struct Drone {
  Place position;
  Speed velocity;
};
void Describe(TypeBuilder<Drone>& type) {
  type.Name("Drone").Field("position", &Drone::position).Field("velocity", &Drone::velocity);
}
struct Arm {
  std::array<Place, 2> joints{};
};
void Describe(TypeBuilder<Arm>& type) { type.Name("Arm").Field("joints", &Arm::joints); }

class Commands : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(rig.Prepare()); }
  template <typename Made>
  Made& Create(const std::string& name) {
    return rig.runtime.Create<Made>(rig.runtime.root(), name);
  }

  ModuleRig<RateLimiterFilter> rig{100ms};
  Group& others = rig.runtime.Create<Group>(rig.runtime.root(), "others");
};

/// What is read of what was wished before a person held another value, once the person has let go.
template <typename T>
T HeldMeanwhile(const T& wish, const T& held) {
  ModuleRig<RateLimiterFilter> rig(100ms);
  EXPECT_TRUE(rig.Prepare());
  auto& others = rig.runtime.Create<Group>(rig.runtime.root(), "others");
  Output<T> planner(others, "planner");
  Input<T> driven(others, "driven");
  EXPECT_TRUE(driven.SetDriving(true, AnyValue(TypeOf<T>(), std::make_shared<const T>())));
  EXPECT_TRUE(Port::Connect(planner, driven));
  planner.Publish(wish);
  EXPECT_TRUE(driven.PublishByHand(Filled(held)));
  rig.Wait(1s);
  EXPECT_TRUE(driven.Release());
  const T read = driven.Get();
  driven.DisconnectAll();
  return read;
}

TEST(KindOfCommand, ACarWithASpeedOfItsSteeringDoesNotGoOn) {
  EXPECT_EQ(HeldMeanwhile<Ackermann>({0.1, 0, 1}, {}).speed, 0);
}

TEST(KindOfCommand, APlaceBesideItsVelocityStaysAlsoWhereBothAreTypes) {
  EXPECT_EQ(HeldMeanwhile<Drone>({{7}, {}}, {{7}, {}}).position.x, 7);
}

TEST(KindOfCommand, PlacesOfAnArrayStay) {
  EXPECT_EQ(HeldMeanwhile<Arm>({{{{7}, {3}}}}, {{{{7}, {3}}}}).joints[1].x, 3);
}

template <Ageing kAgeing>
struct Gear final : Module {
  using Module::Module;
  Input<double> in{this, "in", {.unit = "m/s", .ageing = kAgeing}};
  Output<double> out{this, "out", {.unit = "rad/s"}};
  void Update() override { Turn(); }
  void Turn() {
    if (const auto read = in.Read()) out.Publish(*read / 0.1, read.timestamp());
  }
};

class Gears : public Commands {
 protected:
  template <Ageing kAgeing>
  void TurnFromStandstill() {
    auto& gear = Create<Gear<kAgeing>>("gear");
    Input<double> motor(others, "motor", {.unit = "rad/s", .drives = true});
    ASSERT_TRUE(Port::Connect(gear.out, motor));
    ASSERT_TRUE(Port::Connect(rig.module.out, gear.in));
    const auto wish = [&](int times) {
      for (int i = 0; i < times; ++i) {
        rig.Feed(rig.module.in, 1.0);
        rig.RunCycle();
        gear.Turn();
      }
    };
    wish(1);
    rig.runtime.robot_stop().Press("a test");
    wish(30);
    EXPECT_EQ(motor.Get(), 0);
    ASSERT_TRUE(rig.runtime.robot_stop().Release("a test"));
    wish(2);
    EXPECT_LE(motor.Get(), 3) << "a ramp of 1 m/s^2 is at 0.2 m/s after 0.2 s";
    wish(30);
    EXPECT_EQ(motor.Get(), 10);
    ASSERT_TRUE(gear.in.PublishByHand(Filled(0.0)));
    wish(3);
    ASSERT_TRUE(gear.in.Release());
    gear.Turn();
    EXPECT_EQ(motor.Get(), 0) << "the ramp has made it before the person has let go";
    motor.DisconnectAll();
    gear.in.DisconnectAll();
  }
};
TEST_F(Gears, TurnFromStandstillWhereTheyPassOn) { TurnFromStandstill<Ageing::kPassedOn>(); }
TEST_F(Gears, TurnFromStandstillWhereTheySayNothing) { TurnFromStandstill<Ageing::kUnspecified>(); }
TEST_F(Gears, TurnFromStandstillWhereTheyLookHowOldItIs) { TurnFromStandstill<Ageing::kTimesOut>(); }

struct Steered {
  double steering = 0, speed = 0;
};
void Describe(TypeBuilder<Steered>& type) {
  type.Name("Steered")
      .Field("steering", &Steered::steering, {.unit = "rad"})
      .Field("speed", &Steered::speed, {.unit = "m/s"});
}
struct Stamped {
  double stamp = 0;
  Twist2 twist;
};
void Describe(TypeBuilder<Stamped>& type) {
  type.Name("Stamped").Field("stamp", &Stamped::stamp, {.unit = "s"}).Field("twist", &Stamped::twist);
}

Twist2 Made(double speed, Twist2 /*kind*/) { return {speed, 0}; }
Steered Made(double speed, Steered /*kind*/) { return {0.1, speed}; }
Stamped Made(double speed, const Stamped& /*kind*/) { return {0, {speed, 0}}; }
double SpeedOf(const Twist2& command) { return command.forward; }
double SpeedOf(const Steered& command) { return command.speed; }
double SpeedOf(const Stamped& command) { return command.twist.forward; }

template <typename T, Ageing kAgeing>
struct Compose final : Module {
  using Module::Module;
  Input<double> forward{this, "forward", {.unit = "m/s", .ageing = kAgeing}};
  Output<T> command{this, "command"};
  void Update() override { Turn(); }
  void Turn() {
    if (const auto read = forward.Read()) command.Publish(Made(*read, T{}), read.timestamp());
  }
};
template <typename T, Ageing kAgeing>
void ComposedFromStandstill() {
  ModuleRig<RateLimiterFilter> rig(100ms);
  ASSERT_TRUE(rig.Prepare());
  auto& composing = rig.runtime.Create<Compose<T, kAgeing>>(rig.runtime.root(), "composing");
  auto& others = rig.runtime.Create<Group>(rig.runtime.root(), "others");
  Input<T> base(others, "base", {.drives = true, .safe_value = AnyValue(TypeOf<T>(), std::make_shared<const T>())});
  ASSERT_TRUE(Port::Connect(composing.command, base));
  ASSERT_TRUE(Port::Connect(rig.module.out, composing.forward));
  const auto wish = [&](int times) {
    for (int i = 0; i < times; ++i) {
      rig.Feed(rig.module.in, 1.0);
      rig.RunCycle();
      composing.Turn();
    }
  };
  rig.runtime.robot_stop().Press("a test");
  wish(30);
  ASSERT_TRUE(rig.runtime.robot_stop().Release("a test"));
  wish(2);
  EXPECT_LE(SpeedOf(base.Get()), 0.3) << "a ramp of 1 m/s^2 is at 0.2 m/s after 0.2 s";
  wish(30);
  ASSERT_TRUE(composing.forward.PublishByHand(Filled(0.0)));
  wish(3);
  ASSERT_TRUE(composing.forward.Release());
  composing.Turn();
  EXPECT_EQ(SpeedOf(base.Get()), 0) << "made before the person has let go";
  base.DisconnectAll();
  composing.forward.DisconnectAll();
}
template <typename T>
class Composed : public ::testing::Test {};
using Composites = ::testing::Types<Twist2, Steered, Stamped>;
TYPED_TEST_SUITE(Composed, Composites);
TYPED_TEST(Composed, BeginsFromStandstillWhereNumbersTimeOut) {
  ComposedFromStandstill<TypeParam, Ageing::kTimesOut>();
}
TYPED_TEST(Composed, BeginsFromStandstillWhereNothingIsSaid) {
  ComposedFromStandstill<TypeParam, Ageing::kUnspecified>();
}
TYPED_TEST(Composed, BeginsFromStandstillWhereNumbersArePassedOn) {
  ComposedFromStandstill<TypeParam, Ageing::kPassedOn>();
}

TEST_F(Commands, WhatAPersonHasLetGoWhileARuleHeldDoesNotDriveWhenTheRuleEnds) {
  Output<double> planner(others, "planner");
  Input<double> wheels(others, "wheels", {.unit = "m/s", .drives = true});
  ASSERT_TRUE(Port::Connect(planner, wheels));
  Port* const ports[] = {&planner, &wheels};
  for (Port* const held : ports) {
    planner.Publish(1);
    rig.Wait(1s);
    ASSERT_TRUE(held->PublishByHand(Filled(0.0)));
    ASSERT_TRUE(wheels.PublishByHand(Filled(0.1), Port::Setter::kRule));
    rig.Wait(1s);
    ASSERT_TRUE(held->Release());
    EXPECT_EQ(wheels.Get(), 0.1) << held->path();
    rig.Wait(1s);
    ASSERT_TRUE(wheels.Release(Port::Setter::kRule));
    EXPECT_EQ(wheels.Get(), 0) << held->path();
    rig.Wait(1s);
    planner.Publish(1);
    EXPECT_EQ(wheels.Get(), 1) << held->path();
  }
  wheels.DisconnectAll();
}

TEST_F(Commands, NorDoesItWhenTwoRulesEndOneAfterTheOther) {
  Output<double> planner(others, "planner");
  auto& gate = rig.runtime.Create<ProxyPort>(others, "gate", Port::Direction::kInput, TypeOf<double>());
  Input<double> wheels(others, "wheels", {.unit = "m/s", .drives = true});
  ASSERT_TRUE(Port::Connect(planner, gate));
  ASSERT_TRUE(Port::Connect(gate, wheels));
  for (const auto& [first, second] : {std::pair<Port*, Port*>{&gate, &wheels}, {&wheels, &gate}}) {
    planner.Publish(1);
    rig.Wait(1s);
    ASSERT_TRUE(planner.PublishByHand(Filled(0.0)));
    ASSERT_TRUE(gate.PublishByHand(Filled(0.1), Port::Setter::kRule));
    ASSERT_TRUE(wheels.PublishByHand(Filled(0.2), Port::Setter::kRule));
    rig.Wait(1s);
    ASSERT_TRUE(planner.Release());
    ASSERT_TRUE(first->Release(Port::Setter::kRule));
    rig.Wait(1s);
    ASSERT_TRUE(second->Release(Port::Setter::kRule));
    EXPECT_EQ(wheels.Get(), 0) << first->path();
    rig.Wait(1s);
  }
  wheels.DisconnectAll();
  gate.DisconnectAll();
}

// Whoever lets go farther up takes nothing away from another person.
TEST_F(Commands, WhatIsHeldBehindGoesOn) {
  auto& gear = Create<Gear<Ageing::kPassedOn>>("gear");
  Output<double> planner(others, "planner");
  Input<double> motor(others, "motor", {.unit = "rad/s", .drives = true});
  auto& border = rig.runtime.Create<ProxyPort>(others, "border", Port::Direction::kInput, TypeOf<double>());
  ASSERT_TRUE(Port::Connect(gear.out, border));
  ASSERT_TRUE(Port::Connect(border, motor));
  ASSERT_TRUE(Port::Connect(planner, gear.in));
  Port* const ports[] = {&gear.out, &border};
  for (Port* const held : ports) {
    ASSERT_TRUE(held->PublishByHand(Filled(0.3)));
    rig.Wait(1s);
    ASSERT_TRUE(planner.PublishByHand(Filled(0.0)));
    rig.Wait(1s);
    ASSERT_TRUE(planner.Release());
    EXPECT_EQ(motor.Get(), 0.3) << held->path();
    ASSERT_TRUE(held->Release());
  }
  motor.DisconnectAll();
  border.DisconnectAll();
  gear.in.DisconnectAll();
}

// As signal/linear, whose ports have no unit.
struct Scale final : Module {
  using Module::Module;
  Input<double> in{this, "in", {.ageing = Ageing::kPassedOn}};
  Output<double> out{this, "out"};
  void Update() override {
    if (const auto read = in.Read()) out.Publish(*read, read.timestamp());
  }
};
// A recorder says no unit, and may be there before the driver is.
class Places : public Commands {
 protected:
  void StayWhoeverLooksOn(Port& marked) {
    Input<double> joint(others, "joint", {.unit = "rad"});
    ProbePort recorder(others, "recorder", TypeOf<double>());
    Input<double> reader(others, "reader");
    Input<Signal> display(others, "display");
    ASSERT_TRUE(marked.SetDriving(true, AnyValue(0.0), {}, DrivingKind::kPosition));
    Port* const readers[] = {&recorder, &display, &joint, &reader};
    for (Port* const each : readers) ASSERT_TRUE(Port::Connect(marked, *each));
    const auto wish = [&] {
      rig.Feed(rig.module.in, 1.2);
      rig.RunCycle();
      scale.Update();
    };
    for (int i = 0; i < 30; ++i) wish();
    EXPECT_THAT(joint.Get(), DoubleNear(1.2, 1e-9));
    rig.Wait(1s);
    wish();
    EXPECT_THAT(joint.Get(), DoubleNear(1.2, 1e-9)) << "after a gap";
    Port* const ports[] = {&joint, &marked};
    for (Port* const held : ports) {
      ASSERT_TRUE(held->PublishByHand(Filled(1.2)));
      rig.Wait(1s);
      ASSERT_TRUE(held->Release());
      EXPECT_THAT(joint.Get(), DoubleNear(1.2, 1e-9)) << held->path();
    }
    marked.DisconnectAll();
  }
  Scale& scale = Create<Scale>("scale");
};
TEST_F(Places, StayWhoeverLooksOn) { StayWhoeverLooksOn(rig.module.out); }
TEST_F(Places, StayWhoeverLooksOnAlsoFartherUp) {
  ASSERT_TRUE(Port::Connect(rig.module.out, scale.in));
  StayWhoeverLooksOn(scale.out);
  scale.in.DisconnectAll();
}

}  // namespace
}  // namespace runnel::signal

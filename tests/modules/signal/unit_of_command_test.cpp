// Which unit counts where somebody has marked an output, a group's port or an input, and who reads it says none or reads it
// converted.

#include <string>

#include <gmock/gmock.h>

#include "core/module/group.h"
#include "core/port/proxy_port.h"
#include "core/types/type_of.h"
#include "modules/signal/filters.h"
#include "modules/types/pose.h"
#include "plugins/testing/module_rig.h"
#include "tests/modules/signal/filled.h"

namespace runnel::signal {
namespace {

using test::ModuleRig;
using ::testing::HasSubstr;
using namespace std::chrono_literals;

struct Volts {
  double left = 0, right = 0;
};
void Describe(TypeBuilder<Volts>& type) {
  type.Name("Volts").Field("left", &Volts::left, {.unit = "V"}).Field("right", &Volts::right, {.unit = "V"});
}
struct Mixed {
  double place = 0, speed = 0;
};
void Describe(TypeBuilder<Mixed>& type) {
  type.Name("Mixed").Field("place", &Mixed::place, {.unit = "m"}).Field("speed", &Mixed::speed, {.unit = "m/s"});
}

struct Transmission final : Module {
  using Module::Module;
  Input<double> in{this, "in", {.unit = "m/s", .ageing = Ageing::kPassedOn}};
  Output<double> out{this, "out", {.unit = "rad/s"}};
  void Update() override {
    if (const auto read = in.Read()) out.Publish(*read / 0.1, read.timestamp());
  }
};

class UnitOfCommand : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(rig.Prepare()); }
  void Hold(Port& port, double value) {
    ASSERT_TRUE(port.PublishByHand(Filled(value)));
    rig.Wait(1s);
    ASSERT_TRUE(port.Release());
  }
  void Wish(double value, int times) {
    for (int i = 0; i < times; ++i) {
      rig.Feed(rig.module.in, value);
      rig.RunCycle();
    }
  }
  template <typename T>
  void BeginsFromStandstill(const std::string& unit, const ConnectOptions& options) {
    Input<T> driver(others, "driver", {.unit = unit});
    Port& ramp = rig.module.out;
    ASSERT_TRUE(ramp.SetDriving(true, AnyValue(0.0), {}, DrivingKind::kEffort));
    ASSERT_TRUE(Port::Connect(ramp, driver, options));
    Wish(12, 150);
    rig.runtime.robot_stop().Press("a test");
    Wish(12, 30);
    ASSERT_TRUE(rig.runtime.robot_stop().Release("a test"));
    Wish(12, 2);
    EXPECT_LE(driver.Get(), 2) << "two cycles after the release";
    Wish(12, 150);
    Hold(ramp, 0);
    EXPECT_EQ(driver.Get(), 0) << "made before the person has let go";
    driver.DisconnectAll();
  }

  ModuleRig<RateLimiterFilter> rig{100ms};
  Group& others = rig.runtime.Create<Group>(rig.runtime.root(), "others");
};

TEST_F(UnitOfCommand, IsNotNeededWhereItIsSaidToBeAVelocity) {
  auto& gear = rig.runtime.Create<Transmission>(rig.runtime.root(), "gear");
  Input<double> motor(others, "motor");
  auto& border = rig.runtime.Create<ProxyPort>(others, "border", Port::Direction::kInput, TypeOf<double>());
  ASSERT_TRUE(Port::Connect(gear.out, border));
  ASSERT_TRUE(Port::Connect(border, motor));
  ASSERT_TRUE(Port::Connect(rig.module.out, gear.in));
  ASSERT_TRUE(border.SetDriving(true, AnyValue(0.0), {}, DrivingKind::kVelocity));
  const auto wish = [&](int times) {
    for (int i = 0; i < times; ++i) {
      Wish(1, 1);
      gear.Update();
    }
  };
  wish(30);
  rig.runtime.robot_stop().Press("a test");
  wish(30);
  ASSERT_TRUE(rig.runtime.robot_stop().Release("a test"));
  wish(2);
  EXPECT_LE(motor.Get(), 3) << "a ramp of 1 m/s^2 is at 0.2 m/s after 0.2 s";
  wish(30);
  Port* const ports[] = {&gear.out, &border, &motor};
  for (Port* const held : ports) {
    Hold(*held, 0);
    EXPECT_EQ(motor.Get(), 0) << held->path();
    wish(30);
  }
  border.DisconnectAll();
  gear.in.DisconnectAll();
}

TEST_F(UnitOfCommand, HasToBeSaidOrElseWhatItIs) {
  Input<double> motor(others, "motor");
  const auto refused = motor.SetDriving(true, AnyValue(0.0));
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().ToString(), HasSubstr("says whether it is a position, a velocity or an effort"));
  EXPECT_FALSE(motor.is_driving());
  EXPECT_THROW(Input<double>(others, "other", {.drives = true, .safe_value = AnyValue(0.0)}), ElementError);
  EXPECT_EQ(others.Find("motor").has_value(), true);
  Input<double> drive(others, "drive",
                      {.drives = true, .command = DrivingKind::kVelocity, .safe_value = AnyValue(0.0)});
  EXPECT_EQ(drive.stop()->command(), DrivingKind::kVelocity);
  Input<bool> lamp(others, "lamp",
                   {.drives = true, .safe_value = AnyValue(false)});  // there is nothing between its values
  EXPECT_EQ(lamp.stop()->command(), DrivingKind::kEffort);
}

TEST_F(UnitOfCommand, OfAPartOfAPlaceIsNotKnownButSaid) {
  Output<Pose2> planner(others, "planner");
  Input<double> servo(others, "servo");
  ASSERT_TRUE(Port::Connect(planner, servo, {.part = "heading"}));
  ASSERT_TRUE(servo.SetDriving(true, AnyValue(0.0), {}, DrivingKind::kPosition));
  planner.Publish({0, 0, 1.2});
  rig.Wait(1s);
  Hold(servo, 1.2);
  EXPECT_EQ(servo.Get(), 1.2) << "its safe value would be a motion";
  servo.DisconnectAll();
}

// A motor that says nothing reads a part of what is marked.
TEST_F(UnitOfCommand, OfWhatIsMarkedIsThatOfItsParts) {
  Output<Twist2> planner(others, "planner");
  Input<double> motor(others, "motor");
  ASSERT_TRUE(planner.SetDriving(true));
  ASSERT_TRUE(Port::Connect(planner, motor, {.part = "forward"}));
  planner.Publish({1, 0});
  ASSERT_TRUE(planner.PublishByHand(Filled(Twist2{})));
  rig.Wait(1s);
  ASSERT_TRUE(planner.Release());
  EXPECT_EQ(motor.Get(), 0) << "it was said before the person had let go";
  planner.DisconnectAll();
}

TEST_F(UnitOfCommand, CountsAsItIs) { BeginsFromStandstill<double>("V", {}); }
TEST_F(UnitOfCommand, CountsAlsoRounded) { BeginsFromStandstill<int>("V", {.convert = "round"}); }

TEST_F(UnitOfCommand, OfAPartCounts) {
  Output<Volts> planner(others, "planner");
  Input<double> left(others, "left", {.unit = "V"});
  ASSERT_TRUE(planner.SetDriving(true, AnyValue(TypeOf<Volts>(), std::make_shared<const Volts>())));
  ASSERT_TRUE(Port::Connect(planner, left, {.part = "left"}));
  planner.Publish({1, 1});
  ASSERT_TRUE(planner.PublishByHand(Filled(Volts{})));
  rig.Wait(1s);
  ASSERT_TRUE(planner.Release());
  EXPECT_EQ(left.Get(), 0);
  planner.DisconnectAll();
}

TEST_F(UnitOfCommand, OfASpeedBesideAPlaceMovesNoPlace) {
  Output<Mixed> planner(others, "planner");
  Input<double> wheels(others, "wheels", {.unit = "m/s", .drives = true});
  Input<double> arm(others, "arm", {.unit = "m"});
  ASSERT_TRUE(planner.SetDriving(true, AnyValue(TypeOf<Mixed>(), std::make_shared<const Mixed>())));
  ASSERT_TRUE(Port::Connect(planner, wheels, {.part = "speed"}));
  ASSERT_TRUE(Port::Connect(planner, arm, {.part = "place"}));
  planner.Publish({7, 1});
  rig.Wait(1s);
  Hold(wheels, 0);
  EXPECT_EQ(wheels.Get(), 0);
  EXPECT_EQ(arm.Get(), 7);
  planner.DisconnectAll();
}

}  // namespace
}  // namespace runnel::signal

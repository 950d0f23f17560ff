// What a ramp begins with where what moves by it is exchanged, or stands still at another value than zero.

#include <vector>

#include <gmock/gmock.h>

#include "core/module/group.h"
#include "core/port/proxy_port.h"
#include "core/types/type_of.h"
#include "modules/signal/filters.h"
#include "plugins/structure/structure_editor.h"
#include "plugins/testing/module_rig.h"
#include "tests/modules/signal/filled.h"

namespace runnel::signal {
namespace {

using test::ModuleRig;
using ::testing::HasSubstr;
using namespace std::chrono_literals;

template <DrivingKind kKind, int kSafe>
struct Driven final : Module {
  using Module::Module;
  Input<double> in{this, "in", {.drives = true, .command = kKind, .safe_value = AnyValue(double(kSafe))}};
  void Update() override {}
};
using Turning = Driven<DrivingKind::kVelocity, 0>;
using Reaching = Driven<DrivingKind::kPosition, 2>;

class KindOfDriving : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(rig.Prepare()); }
  void Wish(double value, int times) {
    for (int i = 0; i < times; ++i) {
      rig.Feed(rig.module.in, value);
      rig.RunCycle();
    }
  }
  /// A position goes on from its safe one after a STOP, and from where it is after a silence.
  void ExpectToGoOnFrom(double safe, const Port& servo) {
    const auto read = [&] {
      double value = 0;
      servo.VisitLatest([&](const void* at, ValueTimes) { value = *static_cast<const double*>(at); });
      return value;
    };
    Wish(3, 50);
    EXPECT_EQ(read(), 3);
    rig.runtime.robot_stop().Press("a test");
    Wish(3, 5);
    ASSERT_TRUE(rig.runtime.robot_stop().Release("a test"));
    Wish(3, 2);
    EXPECT_GE(read(), safe - 0.1);
    Wish(3, 50);
    rig.Wait(2s);
    Wish(3, 1);
    EXPECT_GE(read(), 2.9) << "after a silence";
  }
  ModuleRig<RateLimiterFilter> rig{100ms};
  Group& others = rig.runtime.Create<Group>(rig.runtime.root(), "others");
};

TEST_F(KindOfDriving, IsThatOfWhatARampIsConnectedToNow) {
  Input<double> motor(others, "motor", {.unit = "rad/s", .drives = true});
  Input<double> servo(others, "servo", {.unit = "rad", .drives = true, .safe_value = AnyValue(2.0)});
  ASSERT_TRUE(Port::Connect(rig.module.out, motor));
  Wish(3, 10);
  ASSERT_TRUE(Port::Disconnect(rig.module.out, motor));
  ASSERT_TRUE(Port::Connect(rig.module.out, servo));
  ExpectToGoOnFrom(2, servo);
  ASSERT_TRUE(Port::Disconnect(rig.module.out, servo));
  ASSERT_TRUE(Port::Connect(rig.module.out, motor));
  rig.runtime.robot_stop().Press("a test");
  Wish(3, 5);
  ASSERT_TRUE(rig.runtime.robot_stop().Release("a test"));
  Wish(3, 2);
  EXPECT_LE(motor.Get(), 0.3) << "and the other way round";
  motor.DisconnectAll();
}

TEST_F(KindOfDriving, IsThatOfTheModuleThatIsThereNow) {
  ModuleRegistry modules;
  ASSERT_TRUE(
      modules.Add({"test/turning", "", "test", [](const Placement& at) { return std::make_unique<Turning>(at); }}));
  ASSERT_TRUE(
      modules.Add({"test/reaching", "", "test", [](const Placement& at) { return std::make_unique<Reaching>(at); }}));
  StructureEditor editor{rig.runtime, modules, nullptr};
  ASSERT_TRUE(editor.Apply({CreateModule{"/motor", "test/turning"}, ConnectPorts{rig.module.out.path(), "/motor/in"}}));
  Wish(3, 10);
  ASSERT_TRUE(editor.Apply({ReplaceModule{"/motor", "test/reaching"}}));
  const auto& servo = dynamic_cast<Reaching&>(**rig.runtime.root().Find("/motor"));
  EXPECT_EQ(servo.in.stop()->command(), DrivingKind::kPosition);
  ExpectToGoOnFrom(2, servo.in);
}

struct OfItsOwn final : Module {
  using Module::Module;
  Input<double> in{this, "in", {.ageing = Ageing::kTimesOut}};
  Output<double> out{this, "out"};
  void Update() override {}
};

TEST_F(KindOfDriving, IsKnownFartherUpOnceAModuleIsThereThatPassesOn) {
  ModuleRegistry modules;
  ASSERT_TRUE(
      modules.Add({"test/own", "", "test", [](const Placement& at) { return std::make_unique<OfItsOwn>(at); }}));
  ASSERT_TRUE(
      modules.Add({"test/linear", "", "test", [](const Placement& at) { return std::make_unique<LinearFilter>(at); }}));
  StructureEditor editor{rig.runtime, modules, nullptr};
  Input<double> motor(others, "motor", {.unit = "rad/s", .drives = true});
  ASSERT_TRUE(editor.Apply({CreateModule{"/between", "test/own"}, ConnectPorts{rig.module.out.path(), "/between/in"},
                            ConnectPorts{"/between/out", "/others/motor"}}));
  EXPECT_EQ(rig.module.out.motion_beginnings(), 0u);
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(editor.Apply({ReplaceModule{"/between", "test/linear"}}));
    EXPECT_NE(rig.module.out.motion_beginnings(), 0u);
    ASSERT_TRUE(editor.Apply({ReplaceModule{"/between", "test/own"}}));
    EXPECT_EQ(rig.module.out.motion_beginnings(), 0u);
  }
  motor.DisconnectAll();
}

TEST_F(KindOfDriving, OfAListNeedsASafeValue) {
  Input<std::vector<double>> joints(others, "joints", {.unit = "rad/s"});
  EXPECT_FALSE(joints.SetDriving(true)) << "a list of nothing stops no joint";
  EXPECT_TRUE(joints.SetDriving(true, {TypeOf<std::vector<double>>(), std::make_shared<std::vector<double>>(2, 0.0)}));
}

// As of a motor controller that stands still at pulses of 1500 us.
TEST_F(KindOfDriving, OfAVelocityMayStandStillAtAnotherNumber) {
  rig.Set("rise", "1000");
  rig.Set("fall", "1000");
  Input<double> pulse(others, "pulse");
  ASSERT_TRUE(pulse.SetDriving(true, AnyValue(1500.0), {}, DrivingKind::kVelocity));
  ASSERT_TRUE(Port::Connect(rig.module.out, pulse));
  Wish(1900, 50);
  EXPECT_EQ(pulse.Get(), 1900);
  rig.runtime.robot_stop().Press("a test");
  Wish(1900, 30);
  EXPECT_EQ(pulse.Get(), 1500);
  ASSERT_TRUE(rig.runtime.robot_stop().Release("a test"));
  Wish(1900, 2);
  EXPECT_GE(pulse.Get(), 1500);
  EXPECT_LE(pulse.Get(), 1700);
  Wish(1900, 50);
  rig.Wait(1s);
  ASSERT_TRUE(pulse.PublishByHand(Filled(1500.0)));
  Wish(1900, 5);
  ASSERT_TRUE(pulse.Release());
  EXPECT_EQ(pulse.Get(), 1500) << "made before the person has let go";
  Wish(1900, 2);
  EXPECT_LE(pulse.Get(), 1700) << "the ramp begins where it stands still";
  pulse.DisconnectAll();
}

// The default may well move; zero of what is only said to be a velocity may be a place farther on.
TEST_F(KindOfDriving, OfAVelocityWithoutAUnitNeedsASafeValue) {
  EXPECT_THROW(
      Input<double>(others, "belt",
                    {.limits = {.default_value = AnyValue(0.3)}, .drives = true, .command = DrivingKind::kVelocity}),
      ElementError);
  auto& border = rig.runtime.Create<ProxyPort>(others, "border", Port::Direction::kInput, TypeOf<double>());
  const auto refused = border.SetDriving(true, {}, {}, DrivingKind::kVelocity);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().ToString(), HasSubstr("no safe value"));
  EXPECT_TRUE(border.SetDriving(true, AnyValue(0.0), {}, DrivingKind::kVelocity));
}

TEST_F(KindOfDriving, IsNotAnotherOneThanItsUnitSays) {
  Input<double> joint(others, "joint", {.unit = "rad"});
  const auto refused = joint.SetDriving(true, AnyValue(0.0), {}, DrivingKind::kVelocity);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().ToString(),
              HasSubstr("/others/joint: is in rad, which is that of a position, and is said to be a velocity"));
  EXPECT_TRUE(joint.SetDriving(true, AnyValue(0.0), {}, DrivingKind::kPosition));
}

template <typename M>
struct Composite final : Group {
  using Group::Group;
  Result<void> Construct() override { return runtime().template Create<M>(*this, "motor"), Result<void>(); }
};

TEST(DrivingKindOfComposites, IsThatOfTheModulesInside) {
  Runtime runtime;
  ModuleRegistry modules;
  ASSERT_TRUE(modules.Add(
      {"test/arm", "", "test", [](const Placement& at) { return std::make_unique<Composite<Reaching>>(at); }}));
  ASSERT_TRUE(modules.Add(
      {"test/wheel", "", "test", [](const Placement& at) { return std::make_unique<Composite<Turning>>(at); }}));
  StructureEditor editor{runtime, modules, nullptr};
  ASSERT_TRUE(editor.Apply({CreateModule{"/hand", "test/arm"}}));
  EXPECT_FALSE(editor.Apply({ReplaceModule{"/hand", "test/wheel"}}));
  ASSERT_TRUE(editor.Apply({DeleteElement{"/hand"}, CreateModule{"/hand", "test/wheel"}}));
  const auto& motor = dynamic_cast<Turning&>(**runtime.root().Find("/hand/motor"));
  EXPECT_EQ(motor.in.stop()->command(), DrivingKind::kVelocity);
  runtime.robot_stop().Press("a test");
  EXPECT_EQ(motor.in.Get(), 0);
}

struct Metres final : Module {
  using Module::Module;
  Input<double> in{this, "in", {.unit = "m"}};
  void Update() override {}
};
struct Numbers final : Module {
  using Module::Module;
  Input<double> in{this, "in"};
  void Update() override {}
};
struct Speeds final : Module {
  using Module::Module;
  Input<double> in{this, "in", {.unit = "m/s"}};
  void Update() override {}
};

TEST(DrivingKindOfMarks, FollowsTheUnitsOfWhatIsThere) {
  Runtime runtime;
  Metres metres({runtime.root(), "metres"});
  Numbers numbers({runtime.root(), "numbers"});
  Speeds speeds({runtime.root(), "speeds"});
  ASSERT_TRUE(metres.in.SetDriving(true, AnyValue(0.5)));
  numbers.in.TakeOver(metres.in);
  EXPECT_EQ(numbers.in.stop()->command(), DrivingKind::kPosition) << "it knows no better";
  EXPECT_FALSE(metres.in.is_driving());
  const auto refused = Port::CheckTakeOver(speeds.in, numbers.in);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().ToString(), HasSubstr("is in m/s, which is that of a velocity, and is said to be a "
                                                    "position; it cannot take over from /numbers/input/in"));
}

}  // namespace
}  // namespace runnel::signal

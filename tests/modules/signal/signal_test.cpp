#include <cmath>

#include <gmock/gmock.h>

#include "modules/signal/filters.h"
#include "plugins/testing/matchers.h"
#include "plugins/testing/module_rig.h"

namespace runnel::signal {
namespace {

using test::KeepsRealTime;
using test::ModuleRig;
using ::testing::DoubleNear;
using namespace std::chrono_literals;

template <typename Filter>
double After(ModuleRig<Filter>& rig, double value) {
  rig.Feed(rig.module.in, value);
  rig.RunCycle();
  return rig.Last(rig.module.out);
}

TEST(LowPassTest, GoesTheWayOfAnExponential) {
  ModuleRig<LowPassFilter> rig(100ms);
  rig.Set("time_constant", "200ms");
  EXPECT_EQ(After(rig, 1), 1) << "begins where the values begin";
  (void)After(rig, 2);
  EXPECT_THAT(After(rig, 2), DoubleNear(2 - std::exp(-1), 1e-12)) << "after one time constant";
  rig.Set("time_constant", "0");
  EXPECT_EQ(After(rig, 7), 7);
}

TEST(LowPassTest, TakesTimeFromTimestamps) {
  LowPass fine, coarse;
  (void)fine.Next(0, 0, 1);
  (void)coarse.Next(0, 0, 1);
  for (int i = 0; i < 9; ++i) (void)fine.Next(1, 0.1, 1);
  EXPECT_THAT(fine.Next(1, 0.1, 1), DoubleNear(coarse.Next(1, 1, 1), 1e-12));
}

TEST(RateLimiterTest, FollowsNoFasterThanAllowed) {
  ModuleRig<RateLimiterFilter> rig(100ms);
  rig.Set("rise", "2");
  rig.Set("fall", "5");
  EXPECT_EQ(After(rig, 1), 1);
  EXPECT_THAT(After(rig, 10), DoubleNear(1.2, 1e-12));
  EXPECT_THAT(After(rig, 10), DoubleNear(1.4, 1e-12));
  EXPECT_THAT(After(rig, -10), DoubleNear(0.9, 1e-12));
  EXPECT_THAT(After(rig, 1), DoubleNear(1.0, 1e-12)) << "what is near enough is reached";
}

// While the robot stands it must not come to what it would have come to.
TEST(RateLimiterTest, BeginsFromAStandstillAfterAStop) {
  ModuleRig<RateLimiterFilter> rig(100ms);
  ASSERT_TRUE(rig.Prepare());
  auto& others = rig.runtime.Create<Group>(rig.runtime.root(), "others");
  Input<double> wheels(others, "wheels", {.unit = "m/s", .drives = true});
  EXPECT_EQ(rig.module.out.motion_beginnings(), 0);
  ASSERT_TRUE(Port::Connect(rig.module.out, wheels));
  EXPECT_NE(rig.module.out.motion_beginnings(), 0);
  for (int i = 0; i < 20; ++i) (void)After(rig, 1);
  EXPECT_EQ(wheels.Get(), 1);
  rig.runtime.robot_stop().Press("a test");
  for (int i = 0; i < 20; ++i) (void)After(rig, 1);
  ASSERT_TRUE(rig.runtime.robot_stop().Release("a test"));
  (void)After(rig, 1);  // of the time of the release itself
  (void)After(rig, 1);
  EXPECT_THAT(wheels.Get(), DoubleNear(0.1, 1e-12)) << "1 m/s^2, of one cycle";
  // However long nothing has come: it is no time in which the robot has driven.
  rig.runtime.robot_stop().Press("a test");
  rig.RunCycles(200);
  ASSERT_TRUE(rig.runtime.robot_stop().Release("a test"));
  rig.Wait(1ms);
  (void)After(rig, 1);
  EXPECT_LT(wheels.Get(), 0.2);
  wheels.DisconnectAll();
}

// Whichever of the two connections is made first.
TEST(RateLimiterTest, BeginsFromAStandstillAlsoBeforeAModuleThatPassesItOn) {
  for (const bool is_first : {true, false}) {
    ModuleRig<RateLimiterFilter> rig(100ms);
    ASSERT_TRUE(rig.Prepare());
    auto& gain = rig.runtime.Create<LinearFilter>(rig.runtime.root(), "gain");
    auto& others = rig.runtime.Create<Group>(rig.runtime.root(), "others");
    Input<double> wheels(others, "wheels", {.unit = "m/s", .drives = true});
    if (is_first) {
      ASSERT_TRUE(Port::Connect(rig.module.out, gain.in));
    }
    ASSERT_TRUE(Port::Connect(gain.out, wheels));
    if (!is_first) {
      ASSERT_TRUE(Port::Connect(rig.module.out, gain.in));
    }
    EXPECT_NE(rig.module.out.motion_beginnings(), 0);
    for (int i = 0; i < 20; ++i) (void)After(rig, 1);
    // Pressed and released between two cycles.
    rig.runtime.robot_stop().Press("a test");
    ASSERT_TRUE(rig.runtime.robot_stop().Release("a test"));
    EXPECT_EQ(After(rig, 1), 0) << "of the time of the release itself";
    EXPECT_THAT(After(rig, 1), DoubleNear(0.1, 1e-8));
    wheels.DisconnectAll();
  }
}

TEST(RateLimiterTest, BeginsFromAStandstillAfterABlockAndASilence) {
  ModuleRig<RateLimiterFilter> rig(100ms);
  ASSERT_TRUE(rig.Prepare());
  auto& others = rig.runtime.Create<Group>(rig.runtime.root(), "others");
  Input<double> wheels(others, "wheels", {.unit = "m/s", .drives = true});
  ASSERT_TRUE(Port::Connect(rig.module.out, wheels));
  for (int i = 0; i < 20; ++i) (void)After(rig, 1);
  ASSERT_TRUE(wheels.Block());
  for (int i = 0; i < 20; ++i) (void)After(rig, 1);
  ASSERT_TRUE(wheels.Unblock());
  EXPECT_THAT(After(rig, 1), DoubleNear(0.1, 1e-12));
  EXPECT_THAT(After(rig, 1), DoubleNear(0.2, 1e-12));
  rig.RunCycles(20);  // nothing has come, and so nothing moves
  EXPECT_THAT(After(rig, 1), DoubleNear(0.1, 1e-12));
  wheels.DisconnectAll();
}

// As of a driver whose commands are degrees per second, or just numbers.
TEST(RateLimiterTest, BeginsFromAStandstillAlsoBeforeANumberWithoutAUnit) {
  ModuleRig<RateLimiterFilter> rig(100ms);
  ASSERT_TRUE(rig.Prepare());
  auto& others = rig.runtime.Create<Group>(rig.runtime.root(), "others");
  Input<double> valve(others, "valve");
  ASSERT_TRUE(valve.SetDriving(true, AnyValue(0.0), {}, DrivingKind::kEffort));
  ASSERT_TRUE(Port::Connect(rig.module.out, valve));
  rig.runtime.robot_stop().Press("a test");
  for (int i = 0; i < 20; ++i) (void)After(rig, 1);
  ASSERT_TRUE(rig.runtime.robot_stop().Release("a test"));
  (void)After(rig, 1);  // of the time of the release itself
  (void)After(rig, 1);
  EXPECT_THAT(valve.Get(), DoubleNear(0.1, 1e-12));
  valve.DisconnectAll();
}

// As of a joint that has a position to wait in.
TEST(RateLimiterTest, BeginsAtTheSafeNumberAfterAStop) {
  ModuleRig<RateLimiterFilter> rig(100ms);
  ASSERT_TRUE(rig.Prepare());
  auto& others = rig.runtime.Create<Group>(rig.runtime.root(), "others");
  Input<double> joint(others, "joint", {.unit = "rad"});
  ASSERT_TRUE(joint.SetDriving(true, AnyValue(TypeOf<double>(), std::make_shared<const double>(0.5))));
  ASSERT_TRUE(Port::Connect(rig.module.out, joint));
  EXPECT_EQ(After(rig, 3), 3) << "begins where the values begin";
  rig.RunCycles(20);
  EXPECT_THAT(After(rig, 2.9), DoubleNear(2.9, 1e-12)) << "and waits there";
  rig.runtime.robot_stop().Press("a test");
  for (int i = 0; i < 20; ++i) (void)After(rig, 3);
  ASSERT_TRUE(rig.runtime.robot_stop().Release("a test"));
  (void)After(rig, 3);  // of the time of the release itself
  (void)After(rig, 3);
  EXPECT_THAT(joint.Get(), DoubleNear(0.6, 1e-12));
  ASSERT_TRUE(joint.SetDriving(true, AnyValue(TypeOf<double>(), std::make_shared<const double>(0.25))));
  rig.runtime.robot_stop().Press("a test");
  ASSERT_TRUE(rig.runtime.robot_stop().Release("a test"));
  (void)After(rig, 3);
  (void)After(rig, 3);
  EXPECT_THAT(joint.Get(), DoubleNear(0.35, 1e-8)) << "at the one that it has now";
  joint.DisconnectAll();
}

TEST(RateLimiterTest, WhatItHasMadeWhileARuleHeldThePortMovesNothing) {
  ModuleRig<RateLimiterFilter> rig(100ms);
  ASSERT_TRUE(rig.Prepare());
  auto& others = rig.runtime.Create<Group>(rig.runtime.root(), "others");
  Input<double> wheels(others, "wheels", {.unit = "m/s", .drives = true});
  ASSERT_TRUE(Port::Connect(rig.module.out, wheels));
  const Port::Fill zero = [](void* value) -> Result<void> { return *static_cast<double*>(value) = 0, Result<void>(); };
  ASSERT_TRUE(wheels.PublishByHand(zero, Port::Setter::kRule));
  for (int i = 0; i < 20; ++i) (void)After(rig, 1);
  ASSERT_TRUE(wheels.Release(Port::Setter::kRule));
  EXPECT_EQ(wheels.Get(), 0);
  (void)After(rig, 1);
  (void)After(rig, 1);
  EXPECT_THAT(wheels.Get(), DoubleNear(0.2, 1e-12));
  wheels.DisconnectAll();
}

TEST(RateLimiterTest, BeginsFromAStandstillWhenAValueByHandEnds) {
  ModuleRig<RateLimiterFilter> rig(100ms);
  ASSERT_TRUE(rig.Prepare());
  auto& others = rig.runtime.Create<Group>(rig.runtime.root(), "others");
  Input<double> wheels(others, "wheels", {.unit = "m/s", .drives = true});
  Input<double> shown(others, "shown", {.unit = "m/s"});
  ASSERT_TRUE(Port::Connect(rig.module.out, wheels));
  ASSERT_TRUE(Port::Connect(rig.module.out, shown));
  const Port::Fill zero = [](void* value) -> Result<void> { return *static_cast<double*>(value) = 0, Result<void>(); };
  for (Port* held : {static_cast<Port*>(&wheels), static_cast<Port*>(&rig.module.out)}) {
    ASSERT_TRUE(held->PublishByHand(zero));
    for (int i = 0; i < 20; ++i) (void)After(rig, 1);
    ASSERT_TRUE(held->Release());
    EXPECT_EQ(wheels.Get(), 0) << "what it has made meanwhile moves nothing";
    (void)After(rig, 1);
    (void)After(rig, 1);
    EXPECT_THAT(wheels.Get(), DoubleNear(0.2, 1e-12));
  }
  ASSERT_TRUE(shown.PublishByHand(zero));
  (void)After(rig, 1);
  ASSERT_TRUE(shown.Release());
  (void)After(rig, 1);
  EXPECT_THAT(wheels.Get(), DoubleNear(0.4, 1e-12)) << "nothing moves by what is shown";
  wheels.DisconnectAll();
  shown.DisconnectAll();
}

TEST(RateLimiterTest, PassesTheSafeValueOfItsInputAtOnce) {
  ModuleRig<RateLimiterFilter> rig(100ms);
  ASSERT_TRUE(rig.Prepare());
  ASSERT_TRUE(rig.module.in.SetDriving(true, AnyValue(0.25), {}, DrivingKind::kPosition));
  (void)After(rig, 1);
  rig.runtime.robot_stop().Press("a test");
  EXPECT_EQ(After(rig, 1), 0.25);
  rig.RunCycles(3);
  EXPECT_EQ(rig.Last(rig.module.out), 0.25);
  ASSERT_TRUE(rig.runtime.robot_stop().Release("a test"));
  EXPECT_EQ(After(rig, 1), 0.25) << "of the time of the release itself";
  EXPECT_THAT(After(rig, 1), DoubleNear(0.35, 1e-9)) << "and goes on from there";
}

TEST(RateLimiterTest, OfWhatMovesNothingAStopIsNoConcern) {
  ModuleRig<RateLimiterFilter> rig(100ms);
  for (int i = 0; i < 20; ++i) (void)After(rig, 1);
  rig.runtime.robot_stop().Press("a test");
  EXPECT_EQ(After(rig, 1), 1);
}

TEST(RateLimiterTest, WhatIsNoNumberDoesNotStay) {
  ModuleRig<RateLimiterFilter> rig(100ms);
  (void)After(rig, 0);
  EXPECT_TRUE(std::isnan(After(rig, std::nan(""))));
  EXPECT_THAT(After(rig, 10), DoubleNear(0.1, 1e-12));
  ModuleRig<LowPassFilter> smooth;
  (void)After(smooth, 1);
  EXPECT_TRUE(std::isnan(After(smooth, std::nan(""))));
  EXPECT_EQ(After(smooth, 1), 1);
}

TEST(DeadBandTest, IsZeroNearZeroWithoutAJump) {
  ModuleRig<DeadBandFilter> rig;
  rig.Set("width", "0.5");
  EXPECT_EQ(After(rig, 0.4), 0);
  EXPECT_EQ(After(rig, -0.5), 0);
  EXPECT_EQ(After(rig, 0.75), 0.25);
  EXPECT_EQ(After(rig, -0.75), -0.25);
  EXPECT_TRUE(std::isnan(After(rig, std::nan(""))));
}

TEST(LinearTest, IsAFactorAndAnOffset) {
  ModuleRig<LinearFilter> rig;
  rig.Set("gain", "-2");
  rig.Set("offset", "0.5");
  EXPECT_EQ(After(rig, 3), -5.5);
}

TEST(FilterTest, LosesNothingOfAQueueAndKeepsTimestamps) {
  ModuleRig<LinearFilter> rig;
  rig.UseQueue(rig.module.in, 10);
  auto& follower = rig.Follow(rig.module.out);
  const Time first = rig.now();
  rig.Feed(rig.module.in, 1);
  rig.Wait(1s);
  rig.Feed(rig.module.in, 2);
  rig.RunCycle();
  EXPECT_EQ(follower.Take().timestamp(), first);
  EXPECT_EQ(*follower.Take(), 2);
  EXPECT_THAT(rig, KeepsRealTime(3));
}

}  // namespace
}  // namespace runnel::signal

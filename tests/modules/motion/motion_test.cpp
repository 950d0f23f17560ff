#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/log/log_sink.h"
#include "core/module/group.h"
#include "core/types/text_format.h"
#include "modules/motion/command_gate.h"
#include "modules/motion/differential_drive.h"
#include "plugins/testing/module_rig.h"

namespace runnel {
namespace {

using std::chrono::milliseconds;

TEST(DifferentialDrive, TurnsWheelsAsTheyRoll) {
  const DifferentialDrive drive{.wheel_radius = 0.1, .track = 0.5};
  const WheelSpeeds ahead = WheelSpeedsFor(drive, {.forward = 0.3});
  EXPECT_DOUBLE_EQ(ahead.left, 3);
  EXPECT_DOUBLE_EQ(ahead.right, 3);
  const WheelSpeeds left_turn = WheelSpeedsFor(drive, {.turn = 1});
  EXPECT_DOUBLE_EQ(left_turn.left, -2.5);
  EXPECT_DOUBLE_EQ(left_turn.right, 2.5);
}

TEST(DifferentialDrive, SlowsDownAsAWholeSoThatTheCurveStays) {
  const DifferentialDrive drive{.maximum_speed = 0.5, .maximum_turn_rate = 1.5};
  const Twist2 limited = WithinLimits(drive, {1.0, -1.2});
  EXPECT_DOUBLE_EQ(limited.forward, 0.5);
  EXPECT_DOUBLE_EQ(limited.turn, -0.6);
  EXPECT_EQ(WithinLimits(drive, {-0.2, 0.3}), (Twist2{-0.2, 0.3}));
}

TEST(DifferentialDrive, StandsStillRatherThanFollowNonsense) {
  EXPECT_EQ(WithinLimits({}, {std::numeric_limits<double>::quiet_NaN(), 0}), Twist2{});
  EXPECT_EQ(WithinLimits({}, {0, std::numeric_limits<double>::infinity()}), Twist2{});
}

TEST(AccelerationLimit, ComesNearerStepByStep) {
  const AccelerationLimit limit{.forward = 1, .turn = 2};
  EXPECT_EQ(Approach(limit, {0, 0}, {1, -1}, 0.25), (Twist2{0.25, -0.5}));
  EXPECT_EQ(Approach(limit, {0.9, 0}, {1, 0}, 0.25), (Twist2{1, 0}));
}

TEST(CommandGateModule, StopsWhenWhoeverCommandsFallsSilent) {
  test::ModuleRig<CommandGate> rig(milliseconds(100));
  ASSERT_TRUE(rig.module.wanted_timeout.limit.Set(0.25));
  ASSERT_TRUE(rig.Prepare());
  rig.RunCycle();
  EXPECT_EQ(rig.Last(rig.module.state), GateState::kNeverCame);
  rig.Feed(rig.module.wanted, {0.3, 0});
  for (int i = 0; i < 3; ++i) {
    rig.RunCycle();
    EXPECT_EQ(rig.Last(rig.module.allowed), (Twist2{0.3, 0})) << i;
  }
  rig.RunCycle();
  EXPECT_EQ(rig.Last(rig.module.allowed), Twist2{});
  EXPECT_EQ(rig.Last(rig.module.state), GateState::kOld);
}

TEST(CommandGateModule, StopsAtAContactAndWhenTold) {
  test::ModuleRig<CommandGate> rig;
  ASSERT_TRUE(rig.Prepare());
  rig.Feed(rig.module.wanted, {0.3, 0});
  rig.Feed(rig.module.contact, {true, 0.1});
  rig.RunCycle();
  EXPECT_EQ(rig.Last(rig.module.allowed), Twist2{});
  rig.Feed(rig.module.contact, {});
  rig.RunCycle();
  EXPECT_EQ(rig.Last(rig.module.allowed), (Twist2{0.3, 0}));
  ASSERT_TRUE(rig.module.stop.Set(true));
  rig.RunCycle();
  EXPECT_EQ(rig.Last(rig.module.allowed), Twist2{});
  EXPECT_EQ(rig.Last(rig.module.state), GateState::kStopped);
}

TEST(CommandGateModule, StopsAtWhatIsNoNumberAndWhenTheBumperFallsSilent) {
  test::ModuleRig<CommandGate> rig;
  const auto drive = [&](double forward, int cycles) {
    for (; cycles > 0; --cycles) {
      rig.Feed(rig.module.wanted, {forward, 0});
      rig.RunCycle();
    }
    return rig.Last(rig.module.state);
  };
  EXPECT_EQ(drive(0.3, 30), GateState::kOpen) << "who has no bumper needs none";
  EXPECT_EQ(drive(std::nan(""), 1), GateState::kNotANumber);
  EXPECT_EQ(rig.Last(rig.module.allowed), Twist2{});
  rig.Feed(rig.module.contact, {});
  EXPECT_EQ(drive(0.3, 1), GateState::kOpen);
  EXPECT_EQ(drive(0.3, 12), GateState::kOldContact);
  EXPECT_EQ(rig.Last(rig.module.allowed), Twist2{});
  rig.Feed(rig.module.contact, {});
  EXPECT_EQ(drive(0.3, 1), GateState::kOpen);
}

// The same words as others', in the log, and as the value of `state`.
TEST(CommandGateModule, SaysWhyACommandDoesNotPass) {
  test::ModuleRig<CommandGate> rig;
  std::vector<std::string> told;
  const LogSink sink(rig.runtime, [&](const LogMessage& message) { told.push_back(message.text); });
  const auto after = [&](std::optional<Twist2> wanted, int cycles) {
    told.clear();
    if (wanted) rig.Feed(rig.module.wanted, *wanted);
    rig.RunCycles(static_cast<std::uint64_t>(cycles));
    FlushLog();
    return TextOf(rig.Last(rig.module.state)) + (told.empty() ? "" : ": " + told.back());
  };
  EXPECT_EQ(after({}, 12), "never_came: wanted has never come");
  EXPECT_EQ(after(Twist2{0.3, 0}, 1), "open: wanted is there again");
  EXPECT_EQ(after({}, 12), "old: wanted is old");
  EXPECT_EQ(after(Twist2{std::nan(""), 0}, 1), "not_a_number: wanted is not a number");
  EXPECT_EQ(after(Twist2{0.3, 0}, 1), "open: wanted is there again");
  rig.Feed(rig.module.contact, {});
  EXPECT_EQ(after(Twist2{0.3, 0}, 1), "open");
  rig.RunCycles(8);
  EXPECT_EQ(after(Twist2{0.3, 0}, 4), "old_contact: contact is old");
}

TEST(CommandGateModule, WaitsForABumperThatIsConnectedAndHasNotSpoken) {
  test::ModuleRig<CommandGate> rig;
  Output<Contact> bumper(rig.runtime.root(), "bumper");
  ASSERT_TRUE(Port::Connect(bumper, rig.module.contact));
  rig.Feed(rig.module.wanted, {0.3, 0});
  rig.RunCycle();
  EXPECT_EQ(rig.Last(rig.module.state), GateState::kOldContact);
  EXPECT_EQ(rig.Last(rig.module.allowed), Twist2{});
  rig.Feed(rig.module.contact, {});
  rig.RunCycle();
  EXPECT_EQ(rig.Last(rig.module.state), GateState::kOpen);
}

// As where a deletion is undone: connections come after Prepare(), and there may have been cycles.
TEST(CommandGateModule, WaitsForABumperThatIsConnectedLater) {
  test::ModuleRig<CommandGate> rig;
  rig.Feed(rig.module.wanted, {0.3, 0});
  rig.RunCycle();
  EXPECT_EQ(rig.Last(rig.module.state), GateState::kOpen);
  Output<Contact> bumper(rig.runtime.root(), "bumper");
  ASSERT_TRUE(Port::Connect(bumper, rig.module.contact));
  rig.RunCycle();
  EXPECT_EQ(rig.Last(rig.module.state), GateState::kOldContact);
  ASSERT_TRUE(Port::Disconnect(bumper, rig.module.contact));
  rig.RunCycle();
  EXPECT_EQ(rig.Last(rig.module.state), GateState::kOldContact);
}

TEST(CommandGateModule, WhatPassesIsAsOldAsItWas) {
  test::ModuleRig<CommandGate> rig;
  rig.Feed(rig.module.wanted, {0.3, 0});
  const Time measured = rig.now();
  rig.RunCycles(4);
  Time stamp{};
  rig.module.allowed.VisitLatest([&](const void*, ValueTimes times) { stamp = times.timestamp; });
  EXPECT_EQ(stamp, measured);
}

TEST(StoppedRobot, StandsAtOnceAndBeginsFromAStandstill) {
  test::ModuleRig<DifferentialDriveModule> rig(milliseconds(100));
  const auto drive = [&](int cycles) {
    for (; cycles > 0; --cycles) {
      rig.Feed(rig.module.twist, {0.5, 0});
      rig.RunCycle();
    }
    return rig.Last(rig.module.wheels).left;
  };
  EXPECT_NEAR(drive(10), 10.0, 1e-9);
  ASSERT_TRUE(rig.runtime.robot_stop().Press("a test"));
  EXPECT_EQ(drive(1), 0.0) << "past the ramp";
  EXPECT_EQ(drive(5), 0.0);
  ASSERT_TRUE(rig.runtime.robot_stop().Release("a test"));
  rig.RunCycle();
  EXPECT_EQ(rig.Last(rig.module.wheels).left, 0.0) << "by nothing from before";
  EXPECT_NEAR(drive(1), 2.0, 1e-9) << "1 m/s^2 for 0.1 s";
}

// Whatever the safe value is: its reader has it as long as the STOP is in force.
TEST(StoppedRobot, ItsSafeValueDoesNotGrowOld) {
  test::ModuleRig<DifferentialDriveModule> rig(milliseconds(100));
  rig.Feed(rig.module.twist, {0.5, 0});
  rig.RunCycle();
  ASSERT_TRUE(rig.runtime.robot_stop().Press("a test"));
  rig.RunCycles(20);
  EXPECT_TRUE(rig.module.twist_timeout.Read(rig.module.twist, rig.now()));
  EXPECT_EQ(rig.module.twist_timeout.lack(), InputLack::kNone);
  ASSERT_TRUE(rig.runtime.robot_stop().Release("a test"));
  rig.RunCycles(10);
  EXPECT_EQ(rig.module.twist_timeout.lack(), InputLack::kOld) << "nobody commands it";
}

// A command that was old before is no way to brake on: the robot stands.
TEST(StoppedRobot, DoesNotDriveOffByAnOldCommandWhereItBrakes) {
  test::ModuleRig<DifferentialDriveModule> rig(milliseconds(100));
  ASSERT_TRUE(rig.module.twist.SetDriving(true, {}, std::chrono::seconds(2)));
  rig.Feed(rig.module.twist, {0.5, 0});
  rig.RunCycles(30);
  ASSERT_EQ(rig.Last(rig.module.wheels).left, 0.0) << "it is old";
  ASSERT_TRUE(rig.runtime.robot_stop().Press("a test"));
  for (int i = 0; i < 30; ++i) {
    rig.RunCycle();
    EXPECT_EQ(rig.Last(rig.module.wheels).left, 0.0) << i;
  }
}

TEST(StoppedRobot, ItsGateSaysSo) {
  test::ModuleRig<CommandGate> rig;
  rig.Feed(rig.module.wanted, {0.3, 0});
  rig.RunCycle();
  ASSERT_TRUE(rig.runtime.robot_stop().Press("a test"));
  rig.RunCycle();
  EXPECT_EQ(rig.Last(rig.module.state), GateState::kStopped);
  EXPECT_EQ(rig.Last(rig.module.allowed), Twist2{});
}

TEST(DifferentialDriveModule, BeginsFromAStandstillAfterAPause) {
  test::ModuleRig<DifferentialDriveModule> rig(milliseconds(100));
  for (int i = 0; i < 10; ++i) {
    rig.Feed(rig.module.twist, {0.5, 0});
    rig.RunCycle();
  }
  rig.Wait(std::chrono::seconds(30));
  rig.Feed(rig.module.twist, {0.5, 0});
  rig.RunCycle();
  EXPECT_EQ(rig.Last(rig.module.wheels), WheelSpeeds{});
}

TEST(DifferentialDriveModule, BeginsFromAStandstillAfterOnlyItsWheelsWereHeld) {
  test::ModuleRig<DifferentialDriveModule> rig(milliseconds(100));
  ASSERT_TRUE(rig.Prepare());
  auto& others = rig.runtime.Create<Group>(rig.runtime.root(), "others");
  Input<WheelSpeeds> base(others, "base", {.drives = true});
  ASSERT_TRUE(Port::Connect(rig.module.wheels, base));
  const auto drive = [&](int cycles) {
    for (; cycles > 0; --cycles) {
      rig.Feed(rig.module.twist, {0.5, 0});
      rig.RunCycle();
    }
    return base.Get().left;
  };
  EXPECT_NEAR(drive(10), 10.0, 1e-9);
  ASSERT_TRUE(base.Block());
  EXPECT_EQ(drive(10), 0.0);
  ASSERT_TRUE(base.Unblock());
  EXPECT_EQ(drive(1), 0.0);
  EXPECT_NEAR(drive(1), 2.0, 1e-9) << "1 m/s^2 for 0.1 s";
  base.DisconnectAll();
}

TEST(DifferentialDriveModule, BeginsFromAStandstillAfterAStopBetweenTwoCycles) {
  test::ModuleRig<DifferentialDriveModule> rig(milliseconds(100));
  ASSERT_TRUE(rig.Prepare());
  auto& others = rig.runtime.Create<Group>(rig.runtime.root(), "others");
  Input<WheelSpeeds> base(others, "base", {.drives = true});
  ASSERT_TRUE(Port::Connect(rig.module.wheels, base));
  const auto drive = [&](int cycles) {
    for (; cycles > 0; --cycles) {
      rig.Feed(rig.module.twist, {0.5, 0});
      rig.RunCycle();
    }
    return base.Get().left;
  };
  EXPECT_NEAR(drive(10), 10.0, 1e-9);
  rig.runtime.robot_stop().Press("a test");
  rig.Wait(milliseconds(20));
  ASSERT_TRUE(rig.runtime.robot_stop().Release("a test"));
  rig.Wait(milliseconds(20));
  EXPECT_EQ(drive(1), 0.0);
  base.DisconnectAll();
}

TEST(DifferentialDriveModule, ComesToAStopWhenNobodyCommands) {
  test::ModuleRig<DifferentialDriveModule> rig(milliseconds(100));
  ASSERT_TRUE(rig.Prepare());
  rig.Feed(rig.module.twist, {0.3, 0});
  for (int i = 0; i < 5; ++i) rig.RunCycle();
  EXPECT_GT(rig.Last(rig.module.wheels).left, 0.0);
  for (int i = 0; i < 10; ++i) rig.RunCycle();
  EXPECT_EQ(rig.Last(rig.module.wheels), WheelSpeeds{});
}

TEST(DifferentialDriveModule, GetsFasterNoFasterThanItMay) {
  test::ModuleRig<DifferentialDriveModule> rig(milliseconds(100));
  ASSERT_TRUE(rig.module.twist_timeout.limit.Set(10));
  ASSERT_TRUE(rig.Prepare());
  rig.Feed(rig.module.twist, {2.0, 0});
  rig.RunCycle();
  EXPECT_EQ(rig.Last(rig.module.wheels), WheelSpeeds{}) << "no time has passed yet";
  rig.RunCycle();
  EXPECT_NEAR(rig.Last(rig.module.wheels).left, 0.1 / 0.05, 1e-9);
  for (int i = 0; i < 20; ++i) rig.RunCycle();
  EXPECT_NEAR(rig.Last(rig.module.wheels).left, 0.5 / 0.05, 1e-9);
}

}  // namespace
}  // namespace runnel

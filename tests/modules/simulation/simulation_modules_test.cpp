#include <cmath>

#include <gmock/gmock.h>

#include "modules/simulation/sensors.h"
#include "modules/simulation/simulated_world.h"
#include "plugins/testing/guards.h"
#include "plugins/testing/module_rig.h"
#include "tests/modules/simulation/simulation_fixture.h"

namespace runnel {
namespace {

using std::chrono::milliseconds;
using test::SceneWithAWall;
using test::TemporaryFile;
using testing::HasSubstr;

constexpr const char* kOneWall = R"(<world name="one wall">
  <start x="0" y="0" heading="0"/> <goal x="5" y="1"/>
  <box x="2" y="0" length="1" width="4"/>
</world>)";

TEST(SimulatedWorld, LetsTheRobotDriveAndStopsItAtAWall) {
  const TemporaryFile file(".xml", kOneWall);
  test::ModuleRig<SimulatedWorld> rig;
  ASSERT_TRUE(rig.module.world.SetFromText(file.path()));
  ASSERT_TRUE(rig.Prepare());
  ASSERT_TRUE(rig.module.wheels_timeout.limit.Set(60));
  rig.Feed(rig.module.wheels, {6, 6});
  rig.RunCycle();
  EXPECT_EQ(rig.Last(rig.module.pose), Pose2{}) << "no time has passed yet";
  EXPECT_EQ(rig.Last(rig.module.goal), (Point2{5, 1}));
  for (int i = 0; i < 40; ++i) rig.RunCycle();
  EXPECT_GT(rig.Last(rig.module.pose).x, 0.4);
  EXPECT_FALSE(rig.Last(rig.module.contact).is_touching);
  for (int i = 0; i < 200; ++i) rig.RunCycle();
  EXPECT_NEAR(rig.Last(rig.module.pose).x, 1.5 - 0.15, 0.01);
  EXPECT_TRUE(rig.Last(rig.module.contact).is_touching);
  EXPECT_EQ(rig.module.scene.publications(), 1u);
}

// Drives for a second, at the end of which the robot has its speed.
void DriveFor1s(test::ModuleRig<SimulatedWorld>& rig) {
  for (int i = 0; i < 20; ++i) {
    rig.Feed(rig.module.wheels, {2, 2});
    rig.RunCycle();
  }
}

class SimulatedWorldWithoutCommands : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(rig.module.world.SetFromText(file.path()));
    ASSERT_TRUE(rig.Prepare());
    DriveFor1s(rig);
    ASSERT_NEAR(rig.Last(rig.module.twist).forward, 0.1, 1e-6);
  }

  const TemporaryFile file{".xml", kOneWall};
  test::ModuleRig<SimulatedWorld> rig;  // a cycle takes 50 ms; wheels have a radius of 50 mm
};

TEST_F(SimulatedWorldWithoutCommands, ComesToRestWhenTheTimeOutHasPassed) {
  rig.RunCycles(10);  // 0.5 s after the last command, in the last of them
  EXPECT_NEAR(rig.Last(rig.module.twist).forward, 0.1, 1e-6);
  rig.RunCycles(3);
  EXPECT_NEAR(rig.Last(rig.module.twist).forward, 0.0, 1e-6);
}

TEST_F(SimulatedWorldWithoutCommands, ComesToRestWhenDisconnected) {
  rig.module.wheels.DisconnectAll();
  rig.RunCycles(14);
  EXPECT_NEAR(rig.Last(rig.module.twist).forward, 0.0, 1e-6);
}

TEST_F(SimulatedWorldWithoutCommands, DoesNotNoticeASourceThatIsGoneForLessThanTheTimeOut) {
  Port& feeder = *rig.module.wheels.Sources().at(0);
  ASSERT_TRUE(Port::Disconnect(feeder, rig.module.wheels));
  for (int i = 0; i < 8; ++i) {
    rig.RunCycle();
    ASSERT_NEAR(rig.Last(rig.module.twist).forward, 0.1, 1e-6) << i;
  }
  ASSERT_TRUE(Port::Connect(feeder, rig.module.wheels));
  DriveFor1s(rig);
  EXPECT_NEAR(rig.Last(rig.module.twist).forward, 0.1, 1e-6);
}

TEST_F(SimulatedWorldWithoutCommands, HasNotDrivenOnForAllTheTimeThatItWasPaused) {
  const double before = rig.Last(rig.module.pose).x;
  rig.Wait(std::chrono::seconds(20));
  rig.RunCycle();
  EXPECT_LT(rig.Last(rig.module.pose).x, before + 0.1) << "0.1 m/s for 0.5 s, and to come to rest";
}

TEST_F(SimulatedWorldWithoutCommands, HasNotDrivenOnThoughPausedWhenItWasStopped) {
  const double before = rig.Last(rig.module.pose).x;
  ASSERT_TRUE(rig.runtime.robot_stop().Press("a test"));
  rig.Wait(std::chrono::seconds(20));
  rig.RunCycle();
  EXPECT_LT(rig.Last(rig.module.pose).x, before + 0.02);
  EXPECT_NEAR(rig.Last(rig.module.twist).forward, 0, 1e-6);
}

TEST_F(SimulatedWorldWithoutCommands, GoesOnWhenCommandsComeAgain) {
  rig.RunCycles(20);
  ASSERT_NEAR(rig.Last(rig.module.twist).forward, 0.0, 1e-6);
  DriveFor1s(rig);
  EXPECT_NEAR(rig.Last(rig.module.twist).forward, 0.1, 1e-6);
}

TEST(SimulatedWorld, TakesTheGoalFromParametersIfTheyAreSet) {
  const TemporaryFile file(".xml", kOneWall);
  test::ModuleRig<SimulatedWorld> rig;
  ASSERT_TRUE(rig.module.world.SetFromText(file.path()));
  ASSERT_TRUE(rig.Prepare());
  ASSERT_TRUE(rig.module.goal_x.Set(-3));
  rig.RunCycle();
  EXPECT_EQ(rig.Last(rig.module.goal), (Point2{-3, 1}));
}

TEST(SimulatedWorld, PublishesItsMapWhenTheGoalMoves) {
  const TemporaryFile file(".xml", kOneWall);
  test::ModuleRig<SimulatedWorld> rig;
  ASSERT_TRUE(rig.module.world.SetFromText(file.path()));
  ASSERT_TRUE(rig.Prepare());
  for (int i = 0; i < 3; ++i) rig.RunCycle();
  EXPECT_EQ(rig.module.map.publications(), 1u);
  const WorldMap map = rig.Last(rig.module.map);
  EXPECT_EQ(map.name, "one wall");
  EXPECT_EQ(map.goal, (Point2{5, 1}));
  ASSERT_EQ(map.outlines.size(), 1u);
  EXPECT_EQ(map.outlines[0].points.size(), 4u);

  ASSERT_TRUE(rig.module.goal_x.Set(-3));
  const auto tasks = rig.module.FindAnnotation<Executable>()->tasks();
  const CycleScope cycle({});
  const test::AllocationGuard guard;
  for (const Task& task : tasks) task.run();
  EXPECT_EQ(guard.allocations(), 0u);
  EXPECT_EQ(rig.module.map.publications(), 2u);
  EXPECT_EQ(rig.Last(rig.module.map).goal, (Point2{-3, 1}));
  EXPECT_EQ(rig.Last(rig.module.map).outlines, map.outlines);
}

TEST(SimulatedWorld, SaysWhatIsWrongWithItsFile) {
  test::ModuleRig<SimulatedWorld> without;
  EXPECT_THAT(without.Prepare().error().ToString(), HasSubstr("no world file is named"));

  const TemporaryFile file(".xml", "<world name=\"x\">\n <start x=\"0\" y=\"0\"/>\n <box/>\n</world>");
  test::ModuleRig<SimulatedWorld> rig;
  ASSERT_TRUE(rig.module.world.SetFromText(file.path()));
  const auto prepared = rig.Prepare();
  ASSERT_FALSE(prepared);
  EXPECT_THAT(prepared.error().ToString(), HasSubstr(file.path() + ":3:"));
  EXPECT_THAT(prepared.error().ToString(), HasSubstr("goal"));
}

TEST(SimulatedWorld, RefusesAStartWhereTheRobotDoesNotFit) {
  const TemporaryFile file(".xml", R"(<world name="tight">
    <start x="1.4" y="0"/> <goal x="5" y="1"/> <box x="2" y="0" length="1" width="4"/></world>)");
  test::ModuleRig<SimulatedWorld> rig;
  ASSERT_TRUE(rig.module.world.SetFromText(file.path()));
  const auto prepared = rig.Prepare();
  ASSERT_FALSE(prepared);
  EXPECT_THAT(prepared.error().ToString(),
              testing::AllOf(HasSubstr(file.path()), HasSubstr("does not fit where it starts")));
}

TEST(Laser, RefusesRangesInWhichItSeesNothing) {
  test::ModuleRig<Laser> rig;
  ASSERT_TRUE(rig.module.range_minimum.SetFromText("10"));
  EXPECT_THAT(rig.Prepare().error().ToString(), HasSubstr("sees nothing"));
}

TEST(Laser, AllocatesNothingAfterwardsHoweverLongScansAreHeld) {
  if (!test::AllocationGuard::works()) GTEST_SKIP() << "sanitizers have a malloc of their own";
  test::ModuleRig<Laser> rig;
  ASSERT_TRUE(rig.Prepare());
  Input<RangeScan> reader(rig.runtime.root(), "reader");
  ASSERT_TRUE(Port::Connect(rig.module.scan, reader));
  rig.Feed(rig.module.scene, SceneWithAWall());
  rig.Feed(rig.module.pose, {});
  rig.RunCycle();
  std::vector<Lease<RangeScan>> held;
  held.reserve(4);
  for (int i = 0; i < 4; ++i) {
    rig.Feed(rig.module.pose, {0.1 * i, 0, 0});
    held.push_back(reader.Read());
    const auto tasks = rig.module.FindAnnotation<Executable>()->tasks();
    const CycleScope cycle({});
    const test::AllocationGuard guard;
    for (const Task& task : tasks) task.run();
    EXPECT_EQ(guard.allocations(), 0u) << i;
  }
}

TEST(Laser, ScansOnceForEachPose) {
  test::ModuleRig<Laser> rig;
  ASSERT_TRUE(rig.module.rays.SetFromText("3"));
  ASSERT_TRUE(rig.Prepare());
  rig.RunCycle();
  EXPECT_EQ(rig.module.scan.publications(), 0u) << "nothing to see yet";
  rig.Feed(rig.module.scene, SceneWithAWall());
  rig.Feed(rig.module.pose, {0.5, 0, 0});
  rig.RunCycle();
  rig.RunCycle();
  ASSERT_EQ(rig.module.scan.publications(), 1u);
  const RangeScan scan = rig.Last(rig.module.scan);
  ASSERT_EQ(scan.ranges.size(), 3u);
  EXPECT_FLOAT_EQ(scan.ranges[1], 1.0F);
  EXPECT_TRUE(std::isinf(scan.ranges[0]) && std::isinf(scan.ranges[2]));
}

TEST(Infrared, MeasuresForEachPose) {
  test::ModuleRig<Infrared> rig;
  ASSERT_TRUE(rig.Prepare());
  rig.Feed(rig.module.scene, SceneWithAWall());
  rig.Feed(rig.module.pose, {0.5, 0, kPi / 2});
  rig.RunCycle();
  const InfraredRanges ranges = rig.Last(rig.module.ranges);
  EXPECT_NEAR(ranges.right, 1.0, 1e-9);
  EXPECT_TRUE(std::isinf(ranges.front) && std::isinf(ranges.left));
}

TEST(Localisation, IsPerfectUnlessNoiseIsAskedFor) {
  const Pose2 pose{1, 2, 3};
  test::ModuleRig<Localisation> perfect;
  ASSERT_TRUE(perfect.Prepare());
  perfect.Feed(perfect.module.truth, pose);
  perfect.RunCycle();
  EXPECT_EQ(perfect.Last(perfect.module.pose), pose);

  test::ModuleRig<Localisation> noisy;
  ASSERT_TRUE(noisy.module.position_noise.SetFromText("0.1"));
  ASSERT_TRUE(noisy.Prepare());
  noisy.Feed(noisy.module.truth, pose);
  noisy.RunCycle();
  EXPECT_NE(noisy.Last(noisy.module.pose).x, pose.x);
  EXPECT_EQ(noisy.Last(noisy.module.pose).heading, pose.heading);
}

TEST(Bumper, StaysPressedForAWhile) {
  test::ModuleRig<Bumper> rig(milliseconds(100));
  ASSERT_TRUE(rig.Prepare());
  rig.Feed(rig.module.truth, {true, 0.5});
  rig.RunCycle();
  EXPECT_TRUE(rig.Last(rig.module.contact).is_touching);
  rig.Feed(rig.module.truth, {});
  rig.RunCycle();
  EXPECT_EQ(rig.Last(rig.module.contact), (Contact{true, 0.5}));
  rig.Feed(rig.module.truth, {});
  rig.RunCycle();
  EXPECT_FALSE(rig.Last(rig.module.contact).is_touching);
}

TEST(Localisation, SpreadsPositionAndHeadingApart) {
  test::ModuleRig<Localisation> rig;
  ASSERT_TRUE(rig.module.position_noise.SetFromText("0.1"));
  ASSERT_TRUE(rig.module.heading_noise.SetFromText("0.02"));
  ASSERT_TRUE(rig.module.seed.SetFromText("5"));
  ASSERT_TRUE(rig.Prepare());
  double x_square = 0.0, y_square = 0.0, heading_square = 0.0;
  constexpr int kPoses = 10000;
  for (int i = 0; i < kPoses; ++i) {
    rig.Feed(rig.module.truth, {1, 2, kPi});
    rig.RunCycle();
    const Pose2 pose = rig.Last(rig.module.pose);
    EXPECT_LE(std::abs(pose.heading), kPi);
    x_square += std::pow(pose.x - 1, 2);
    y_square += std::pow(pose.y - 2, 2);
    heading_square += std::pow(WrapAngle(pose.heading - kPi), 2);
  }
  EXPECT_NEAR(std::sqrt(x_square / kPoses), 0.1, 0.004);
  EXPECT_NEAR(std::sqrt(y_square / kPoses), 0.1, 0.004);
  EXPECT_NEAR(std::sqrt(heading_square / kPoses), 0.02, 0.001);
}

}  // namespace
}  // namespace runnel

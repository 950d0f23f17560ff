#include <cmath>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>

#include "modules/simulation/bumper.h"
#include "modules/simulation/infrared.h"
#include "modules/simulation/laser.h"
#include "modules/simulation/localisation.h"
#include "modules/simulation/referee.h"
#include "modules/simulation/simulated_world.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/module_rig.h"

namespace runnel {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;

/// A file of this test program that is gone afterwards.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& text)
      : path_(std::filesystem::path(testing::TempDir()) /
              (testing::UnitTest::GetInstance()->current_test_info()->name() + name)) {
    if (!text.empty()) std::ofstream(path_) << text;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  [[nodiscard]] std::string path() const { return path_.string(); }
  [[nodiscard]] std::string Read() const {
    std::ifstream file(path_);
    return {std::istreambuf_iterator<char>(file), {}};
  }

 private:
  std::filesystem::path path_;
};

constexpr const char* kOneWall = R"(<world name="one wall">
  <start x="0" y="0" heading="0"/> <goal x="5" y="1"/>
  <box x="2" y="0" length="1" width="4"/>
</world>)";

Scene SceneWithAWall() {
  World world{.name = "wall", .start = {}, .goal = {5, 1}};
  world.boxes.push_back({.pose = {2, 0, 0}, .length = 1, .width = 4});
  auto rays = std::make_shared<const RayCaster>(OutlineOf(world), 0.3);
  return {std::make_shared<const World>(world), rays, 0.15};
}

TEST(SimulatedWorld, LetsTheRobotDriveAndStopsItAtAWall) {
  const TemporaryFile file(".xml", kOneWall);
  test::ModuleRig<SimulatedWorld> rig;
  ASSERT_TRUE(rig.module.world.SetFromText(file.path()));
  ASSERT_TRUE(rig.Prepare());
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

  const TemporaryFile file(".xml",
                           "<world name=\"x\">\n <start x=\"0\" y=\"0\"/>\n <box/>\n</world>");
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

class RefereeTest : public testing::Test {
 protected:
  void Begin(const std::string& expected = "either") {
    ASSERT_TRUE(rig.module.expected.SetFromText(expected));
    ASSERT_TRUE(rig.module.time_limit.SetFromText("10"));
    ASSERT_TRUE(rig.Prepare());
    rig.Feed(rig.module.scene, SceneWithAWall());
    rig.Feed(rig.module.goal, {3, 0});
    rig.Feed(rig.module.contact, {});
    At({0, 0, 0}, PlannerMode::kMotionToGoal);
  }
  void At(const Pose2& pose, PlannerMode mode) {
    rig.Feed(rig.module.pose, pose);
    rig.Feed(rig.module.status, PlannerStatus{.mode = mode});
    rig.RunCycle();
  }
  RunMonitor& monitor() { return *rig.module.FindAnnotation<RunMonitor>(); }

  test::ModuleRig<Referee> rig;
};

TEST_F(RefereeTest, GoesOnUntilThereIsAVerdict) {
  Begin();
  EXPECT_FALSE(monitor().Outcome());
  EXPECT_THAT(monitor().Progress(), HasSubstr("3.00 m to the goal, driving"));
}

TEST_F(RefereeTest, BelievesThePlannerOnlyIfItIsThere) {
  Begin();
  At({2.9, 0, 0}, PlannerMode::kReached);
  ASSERT_TRUE(monitor().Outcome());
  EXPECT_EQ(monitor().Outcome()->verdict, "reached");
  EXPECT_TRUE(monitor().Outcome()->success);
  EXPECT_EQ(monitor().Outcome()->summary, "path 2.90 m, time 0.05 s");
}

TEST_F(RefereeTest, CatchesAMistakenPlanner) {
  Begin();
  At({2.5, 0, 0}, PlannerMode::kReached);
  EXPECT_EQ(monitor().Outcome()->verdict, "mistaken");
  EXPECT_FALSE(monitor().Outcome()->success);
}

TEST_F(RefereeTest, CallsUnreachableASuccessOnlyWhereItIsExpected) {
  Begin("reached");
  At({1, 0, 0}, PlannerMode::kUnreachable);
  EXPECT_EQ(monitor().Outcome()->verdict, "unreachable");
  EXPECT_FALSE(monitor().Outcome()->success);
}

TEST_F(RefereeTest, SeesACollisionEvenIfItIsShort) {
  Begin();
  rig.Feed(rig.module.contact, {true, 0});
  At({1, 0, 0}, PlannerMode::kMotionToGoal);
  EXPECT_EQ(monitor().Outcome()->verdict, "collision");
  rig.Feed(rig.module.contact, {});
  At({3, 0, 0}, PlannerMode::kReached);
  EXPECT_EQ(monitor().Outcome()->verdict, "collision") << "the first verdict stands";
}

TEST_F(RefereeTest, EndsARunThatTakesTooLong) {
  Begin();
  rig.Wait(std::chrono::seconds(10));
  At({1, 0, 0}, PlannerMode::kMotionToGoal);
  EXPECT_EQ(monitor().Outcome()->verdict, "timeout");
  EXPECT_FALSE(monitor().Outcome()->success);
}

TEST_F(RefereeTest, EndsARunInWhichTheWorldHasFallenSilent) {
  Begin();
  rig.Wait(std::chrono::seconds(10));
  rig.RunCycle();
  ASSERT_TRUE(monitor().Outcome());
  EXPECT_EQ(monitor().Outcome()->verdict, "timeout");
}

TEST_F(RefereeTest, PublishesThePathAndNeverALongOne) {
  ASSERT_TRUE(rig.module.time_limit.SetFromText("100000"));
  Begin();
  At({0.01, 0, 0}, PlannerMode::kMotionToGoal);
  EXPECT_EQ(rig.module.driven_path.publications(), 1u) << "too near to the point before";
  At({0.1, 0, 0}, PlannerMode::kMotionToGoal);
  EXPECT_EQ(rig.Last(rig.module.driven_path), (Path2{{{0, 0}, {0.1, 0}}}));
  const auto tasks = rig.module.FindAnnotation<Executable>()->tasks();
  for (int i = 2; i < 3000; ++i) {
    rig.Feed(rig.module.pose, {0.1 * (i % 1000), 0.1 * i, 0});
    rig.Wait(milliseconds(1));
    const CycleScope cycle({});
    const test::AllocationGuard guard;
    for (const Task& task : tasks) task.run();
    ASSERT_EQ(guard.allocations(), 0u) << i;
  }
  const Path2 path = rig.Last(rig.module.driven_path);
  EXPECT_LE(path.points.size(), 1000u);
  EXPECT_GT(path.points.size(), 500u);
  EXPECT_EQ(path.points.front(), (Point2{0, 0}));
  EXPECT_NEAR(path.points.back().y, 300, 1);
}

TEST_F(RefereeTest, DrawsThePath) {
  const TemporaryFile picture(".svg", "");
  ASSERT_TRUE(rig.module.picture.SetFromText(picture.path()));
  Begin();
  At({2.9, 0, 0}, PlannerMode::kReached);
  EXPECT_THAT(monitor().Finish().value(), HasSubstr(picture.path()));
  EXPECT_THAT(picture.Read(), testing::AllOf(HasSubstr("<svg"), HasSubstr("reached")));
}

TEST_F(RefereeTest, WritesTheResult) {
  const TemporaryFile result(".json", "");
  ASSERT_TRUE(rig.module.result.SetFromText(result.path()));
  ASSERT_TRUE(rig.module.path_step.SetFromText("1"));
  Begin();
  At({0.5, 0, 0.25}, PlannerMode::kFollowingBoundary);
  rig.Feed(rig.module.points, {.hits = {{0.5, 0}, {2, 0}}, .leaves = {{1, 0.25}}});
  At({2.9, 0, 0}, PlannerMode::kReached);
  EXPECT_THAT(monitor().Finish().value(), HasSubstr(result.path()));
  EXPECT_EQ(result.Read(),
            "{\"outcome\":\"reached\",\"remark\":\"\",\"path_length_m\":2.9,\"sim_time_s\":0.1,"
            "\"cycles\":3,\"robot_radius_m\":0.15,\"hits\":[[0.5,0],[2,0]],\"leaves\":[[1,0.25]],"
            "\"path\":[[0,0,0,0],[0.1,2.9,0,0]],\"modes\":[0,0]}\n");
}

TEST_F(RefereeTest, TellsAMistakenPlannerAsAnError) {
  const TemporaryFile result(".json", "");
  ASSERT_TRUE(rig.module.result.SetFromText(result.path()));
  Begin();
  At({2.5, 0, 0}, PlannerMode::kReached);
  ASSERT_TRUE(monitor().Finish());
  EXPECT_THAT(result.Read(), HasSubstr("\"outcome\":\"error\",\"remark\":\"the planner says"));
}

TEST_F(RefereeTest, RefusesAPictureInAFolderThatIsNotThere) {
  ASSERT_TRUE(rig.module.picture.SetFromText("/nowhere/at/all/path.svg"));
  EXPECT_THAT(rig.Prepare().error().ToString(), HasSubstr("there is no folder '/nowhere/at/all'"));
}

}  // namespace
}  // namespace runnel

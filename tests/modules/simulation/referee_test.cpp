#include "modules/simulation/referee.h"

#include <gmock/gmock.h>

#include "plugins/testing/guards.h"
#include "plugins/testing/module_rig.h"
#include "tests/modules/simulation/simulation_fixture.h"

namespace runnel {
namespace {

using std::chrono::milliseconds;
using test::SceneWithAWall;
using test::TemporaryFile;
using testing::HasSubstr;

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

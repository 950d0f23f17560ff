#include "modules/planning/bug_planner.h"

#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <type_traits>

#include <gmock/gmock.h>

#include "core/types/type_info.h"
#include "plugins/testing/module_rig.h"
#include "tests/modules/planning/variant_index.h"

namespace runnel {
namespace {

class BugPlannerTest : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(rig.Prepare()); }

  /// One cycle in the open, at `pose`.
  void Step(const Pose2& pose) {
    rig.Feed(rig.module.pose, pose);
    rig.Feed(rig.module.surroundings, Surroundings{.sensor_range = 4, .safe_distance = 0.35F, .is_measured = true});
    rig.RunCycle();
  }
  PlannerStatus status() const { return rig.Last(rig.module.status); }

  test::ModuleRig<BugPlannerOf<VariantIndex("bug2")>> rig;
};

TEST_F(BugPlannerTest, IsSilentUntilItKnowsAll) {
  rig.RunCycle();
  Step({});
  EXPECT_EQ(rig.module.twist.publications(), 0u) << "there is no goal yet";
  rig.Feed(rig.module.goal, {3, 0});
  Step({});
  EXPECT_EQ(rig.module.twist.publications(), 1u);
}

TEST_F(BugPlannerTest, IsSilentWithoutANewView) {
  rig.Feed(rig.module.goal, {3, 0});
  Step({});
  rig.RunCycle();
  EXPECT_EQ(rig.module.twist.publications(), 1u) << "so that a gate notices dead sensors";
}

TEST_F(BugPlannerTest, IsSilentWhenNobodyTellsItWhereItIs) {
  rig.Feed(rig.module.goal, {3, 0});
  Step({});
  for (int i = 0; i < 10; ++i) {  // the sensor goes on, the localisation does not
    rig.Feed(rig.module.surroundings, Surroundings{.sensor_range = 4, .safe_distance = 0.35F, .is_measured = true});
    rig.RunCycle();
  }
  EXPECT_EQ(rig.module.twist.publications(), 5u) << "for 0.2 s, not longer";
}

TEST_F(BugPlannerTest, IsSilentWithWhatIsOldOrNoNumber) {
  rig.Feed(rig.module.goal, {3, 0});
  Step({std::nan(""), 0, 0});
  EXPECT_EQ(rig.module.twist.publications(), 0u) << "the pose is no number";
  rig.Feed(rig.module.goal, {std::nan(""), 0});
  Step({});
  EXPECT_EQ(rig.module.twist.publications(), 0u) << "the goal is no number";
  rig.Feed(rig.module.goal, {3, 0});
  rig.Feed(rig.module.pose, {});
  rig.Feed(rig.module.surroundings, Surroundings{.sensor_range = 4, .safe_distance = 0.35F, .is_measured = true});
  rig.Wait(std::chrono::seconds(1));
  rig.RunCycle();
  EXPECT_EQ(rig.module.twist.publications(), 0u) << "view and pose are of one time, and old";
  Step({});
  EXPECT_EQ(rig.module.twist.publications(), 1u);
}

TEST_F(BugPlannerTest, ItsSilenceIsNoTimeWithoutGettingOn) {
  rig.Feed(rig.module.goal, {3, 0});
  Step({});
  Step({});
  rig.Wait(std::chrono::seconds(30));
  Step({0.05, 0, 0});  // it has gone on until its command was old
  EXPECT_EQ(status().mode, PlannerMode::kMotionToGoal);
  EXPECT_LT(rig.module.state().idle_time, 1.0);
}

TEST_F(BugPlannerTest, DrivesToTheGoalInTheOpen) {
  rig.Feed(rig.module.goal, {3, 0});
  Step({});
  Step({0.01, 0, 0});
  EXPECT_GT(rig.Last(rig.module.twist).forward, 0.1);
  EXPECT_EQ(status().mode, PlannerMode::kMotionToGoal);
  EXPECT_NEAR(status().distance_to_goal, 2.99, 1e-9);
}

TEST_F(BugPlannerTest, DrawsWhatItHasInMindWhileSomebodyLooks) {
  rig.Feed(rig.module.goal, {3, 0});
  Step({});
  EXPECT_EQ(rig.module.drawing.publications(), 0u);
  rig.module.drawing.NoteLook();
  rig.Feed(rig.module.pose, {1, 0, kPi / 2});
  Surroundings view{.sensor_range = 4, .safe_distance = 0.35F, .is_measured = true};
  AddBoundaryPoint(view, {.distance = 2, .bearing = 0});
  rig.Feed(rig.module.surroundings, view);
  rig.RunCycle();
  ASSERT_EQ(rig.module.drawing.publications(), 1u);
  Step({1.1, 0});
  EXPECT_EQ(rig.module.drawing.publications(), 1u) << "nobody has looked since";
  const Drawing drawing = rig.Last(rig.module.drawing);
  ASSERT_GE(drawing.items.size(), 2u);
  EXPECT_EQ(drawing.items[0].kind, DrawnKind::kLine);
  EXPECT_EQ(drawing.items[0].points, (std::vector<Point2>{{0, 0}, {3, 0}}));
  ASSERT_EQ(drawing.items[1].points.size(), 1u) << "as it is in the world";
  EXPECT_NEAR(drawing.items[1].points[0].x, 1, 1e-3);
  EXPECT_NEAR(drawing.items[1].points[0].y, 2, 1e-3);
}

TEST_F(BugPlannerTest, StandsStillAtTheGoalAndTakesANewOne) {
  rig.Feed(rig.module.goal, {0.05, 0});
  Step({});
  Step({});
  EXPECT_EQ(status().mode, PlannerMode::kReached);
  EXPECT_EQ(rig.Last(rig.module.twist), Twist2{});
  rig.Feed(rig.module.goal, {3, 0});
  Step({});
  Step({});
  EXPECT_EQ(status().mode, PlannerMode::kMotionToGoal);
}

TEST_F(BugPlannerTest, PublishesItsHitPointsWhenThereIsAnotherOne) {
  rig.Feed(rig.module.goal, {3, 0});
  Step({});
  EXPECT_EQ(rig.module.points.publications(), 0u);
  Surroundings wall{.sensor_range = 4, .safe_distance = 0.35F, .is_measured = true};
  AddBoundaryPoint(wall, {0.3, 0.0});
  for (int i = 0; i < 3; ++i) {
    rig.Feed(rig.module.pose, {0.5, 0, 0});
    rig.Feed(rig.module.surroundings, wall);
    rig.RunCycle();
  }
  EXPECT_EQ(rig.module.points.publications(), 1u);
  EXPECT_EQ(rig.Last(rig.module.points), (HitAndLeavePoints{{{0.5, 0}}, {}}));
}

TEST_F(BugPlannerTest, TakesItsSpeedFromAParameterWhileItRuns) {
  rig.Feed(rig.module.goal, {30, 0});
  Step({});
  ASSERT_TRUE(rig.module.cruise_speed.Set(0.11));
  Step({0.01, 0, 0});
  EXPECT_NEAR(rig.Last(rig.module.twist).forward, 0.11, 1e-9);
}

TEST_F(BugPlannerTest, GoesOnWhereAnotherPlannerWas) {
  rig.Feed(rig.module.goal, {3, 0});
  Step({});
  Step({0.5, 0, 0});
  test::ModuleRig<BugPlannerOf<VariantIndex("tangent_bug")>> other;
  ASSERT_TRUE(other.Prepare());
  other.module.TakeOver(rig.module.state());
  other.Feed(other.module.goal, {3, 0});
  other.Feed(other.module.pose, {0.6, 0, 0});
  other.Feed(other.module.surroundings, Surroundings{.sensor_range = 4, .safe_distance = 0.35F, .is_measured = true});
  other.RunCycle();
  EXPECT_EQ(other.module.state().start, (Point2{0, 0})) << "the same task";
  EXPECT_NEAR(other.Last(other.module.status).path_length, 0.6, 1e-9);
}

// Each byte is set before. What has not gone over after is padding: less than the alignment, before a multiple
// of it.
TEST(BugState, IsDescribedFieldByField) {
  static_assert(std::is_trivially_copyable_v<BugState>);
  BugState full;
  BugState copy;
  std::memset(static_cast<void*>(&full), 1, sizeof full);
  std::memset(static_cast<void*>(&copy), 0, sizeof copy);
  ASSERT_TRUE(CopyValue(TypeOf<BugState>(), &full, &copy));
  const auto* const gone_over = reinterpret_cast<const unsigned char*>(&copy);
  std::size_t missing = 0;
  for (std::size_t i = 0; i < sizeof copy; ++i) {
    const bool is_missing = gone_over[i] == 0;
    EXPECT_TRUE(is_missing || missing == 0 || i % 4 == 0) << "a member ends at byte " << i;
    missing = is_missing ? missing + 1 : 0;
    ASSERT_LT(missing, alignof(BugState)) << "a member is missing in its description, at byte " << i;
  }
}

bool HasStep(const BugPlanner& planner) { return planner.Find("parameter/step").has_value(); }

TEST(BugPlanner, OfDistBugHasItsStepAsAParameter) {
  test::ModuleRig<BugPlannerOf<VariantIndex("dist_bug")>> dist_bug;
  EXPECT_TRUE(HasStep(dist_bug.module));
  test::ModuleRig<BugPlannerOf<VariantIndex("bug1")>> bug1;
  EXPECT_FALSE(HasStep(bug1.module));
}

TEST(BugPlanner, OfDistBugStopsWithAFaultBehindASensorThatOnlyFeels) {
  test::ModuleRig<BugPlannerOf<VariantIndex("dist_bug")>> rig;
  ASSERT_TRUE(rig.Prepare());
  rig.Feed(rig.module.goal, {3, 0});
  rig.Feed(rig.module.pose, {});
  rig.Feed(rig.module.surroundings, Surroundings{.safe_distance = 0.2F, .is_measured = true});
  try {
    rig.RunCycle();
    FAIL() << "it drove blind";
  } catch (const ElementError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("'free_range_step' needs a sensor that sees"));
  }
}

TEST(ComposedBugPlanner, RefusesComponentsThatDoNotFitTogether) {
  test::ModuleRig<ComposedBugPlanner> rig;
  ASSERT_TRUE(rig.module.leave.SetFromText("m_line_closest_so_far"));
  const auto prepared = rig.Prepare();
  ASSERT_FALSE(prepared);
  const std::string text = prepared.error().ToString();
  EXPECT_THAT(text, testing::HasSubstr("/module: the leave condition 'm_line_closest_so_far'"));
  EXPECT_THAT(text, testing::HasSubstr("take motion 'm_line', or leave 'closest_so_far'"));
}

TEST(ComposedBugPlanner, TellsTheNearestNameOfAComponent) {
  test::ModuleRig<ComposedBugPlanner> rig;
  const auto set = rig.module.leave.SetFromText("closest_sofar");
  ASSERT_FALSE(set);
  EXPECT_THAT(set.error().ToString(), testing::HasSubstr("'closest_so_far'"));
}

TEST(ComposedBugPlanner, DrivesLikeTheVariantOfTheSameComponents) {
  test::ModuleRig<ComposedBugPlanner> rig;
  ASSERT_TRUE(rig.module.motion.SetFromText("m_line"));
  ASSERT_TRUE(rig.module.leave.SetFromText("m_line_closer_than_hit"));
  ASSERT_TRUE(rig.Prepare());
  rig.Feed(rig.module.goal, {3, 0});
  for (const double x : {0.0, 0.1}) {
    rig.Feed(rig.module.pose, {x, 0.2 * x, 0});
    rig.Feed(rig.module.surroundings, Surroundings{.sensor_range = 4, .safe_distance = 0.35F, .is_measured = true});
    rig.RunCycle();
  }
  EXPECT_LT(rig.Last(rig.module.twist).turn, 0.0) << "back to the line";
}

}  // namespace
}  // namespace runnel

#include "modules/behaviours/robot_behaviours.h"

#include <chrono>
#include <cmath>

#include <gmock/gmock.h>

#include "modules/behaviours/planner_status_teller.h"
#include "plugins/testing/matchers.h"
#include "plugins/testing/module_rig.h"

namespace runnel {
namespace {

using test::HasPublished;
using test::KeepsRealTime;
using test::ModuleRig;
using ::testing::AllOf;
using ::testing::Field;
using ::testing::Gt;
using ::testing::Lt;

/// A wall `distance` m away towards `bearing`, as wide as `half_width` rad to both sides.
Surroundings WallAt(double distance, double bearing, double half_width = 0.5) {
  Surroundings view;
  view.sensor_range = 5.0F;
  view.safe_distance = 0.35F;
  view.is_measured = true;
  for (double offset = -half_width; offset <= half_width; offset += kSectorWidth) {
    AddBoundaryPoint(view, {distance / std::cos(offset), bearing + offset});
  }
  return view;
}

template <typename Module>
struct Rig : ModuleRig<Module> {
  Rig() { this->Set("stimulation_mode", "enabled"); }
};

TEST(DriveToGoalTest, TurnsAndDrivesUntilItIsThere) {
  Rig<DriveToGoalBehaviour> rig;
  rig.Feed("pose", Pose2{});
  rig.Feed("goal", Point2{0.0, 2.0});
  rig.RunCycle();
  EXPECT_THAT(rig.module.twist.port, HasPublished(AllOf(Field(&Twist2::turn, Gt(0.5)), Field(&Twist2::forward, 0.0))));
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(1.0)));
  EXPECT_THAT(rig.module.target_rating, HasPublished(TargetRating(1.0)));
  rig.Feed("goal", Point2{0.5, 0.0});
  rig.RunCycle();
  EXPECT_THAT(rig.module.twist.port, HasPublished(AllOf(Field(&Twist2::turn, 0.0), Field(&Twist2::forward, Gt(0.3)))));
  EXPECT_THAT(rig.module.target_rating, HasPublished(TargetRating(0.5)));
  rig.Feed("goal", Point2{0.05, 0.0});
  rig.RunCycle();
  EXPECT_THAT(rig.module.twist.port, HasPublished(Twist2{}));
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.0)));
  EXPECT_THAT(rig.module.target_rating, HasPublished(TargetRating(0.0)));
}

TEST(DriveToGoalTest, IsActiveInNothingWhileItCannotTell) {
  Rig<DriveToGoalBehaviour> rig;
  rig.RunCycle();
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.0)));
  EXPECT_THAT(rig.module.target_rating, HasPublished(TargetRating(1.0))) << "it may not say that it is content";
  rig.Feed("goal", Point2{2.0, 0.0});
  rig.Feed("pose", Pose2{});
  rig.RunCycle();
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(1.0)));
  rig.RunCycles(12);
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.0))) << "the pose is old";
  rig.Feed("pose", Pose2{});
  rig.RunCycle();
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(1.0)));
  rig.Feed("pose", Pose2{std::nan(""), 0.0, 0.0});
  rig.RunCycle();
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.0))) << "the pose is no number";
}

TEST(DriveToGoalTest, ItsGoalDoesNotGrowOld) {
  Rig<DriveToGoalBehaviour> rig;
  rig.Feed("goal", Point2{2.0, 0.0});
  rig.RunCycles(100);
  rig.Feed("pose", Pose2{});
  const Time now = rig.now();
  rig.RunCycle();
  Time stamp{};
  rig.module.twist.port.VisitLatest([&](const void*, ValueTimes times) { stamp = times.timestamp; });
  EXPECT_EQ(stamp, now) << "that of the pose";
}

TEST(AvoidObstaclesTest, TurnsAwayTheMoreTheNearer) {
  Rig<AvoidObstaclesBehaviour> rig;
  rig.Feed("surroundings", WallAt(0.6, 0.7));
  rig.RunCycle();
  EXPECT_THAT(rig.module.twist.port, HasPublished(Field(&Twist2::turn, Lt(0.0))));
  const double far = rig.Last(rig.module.activity).value();
  EXPECT_GT(far, 0.0);
  rig.Feed("surroundings", WallAt(0.4, -0.7));
  rig.RunCycle();
  EXPECT_THAT(rig.module.twist.port, HasPublished(Field(&Twist2::turn, Gt(0.0))));
  EXPECT_GT(rig.Last(rig.module.activity).value(), far);
  rig.Feed("surroundings", WallAt(2.0, 0.0));
  rig.RunCycle();
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.0)));
}

TEST(FollowWallTest, KeepsTheWallOnItsHand) {
  Rig<FollowWallBehaviour> rig;
  rig.Feed("surroundings", WallAt(0.31, -kPi / 2, 1.2));
  rig.RunCycle();
  EXPECT_THAT(rig.module.twist.port, HasPublished(AllOf(Field(&Twist2::forward, Gt(0.2)),
                                                        Field(&Twist2::turn, ::testing::DoubleNear(0.0, 0.5)))));
  rig.Feed("surroundings", WallAt(0.31, 0.0, 1.2));
  rig.RunCycle();
  EXPECT_THAT(rig.module.twist.port, HasPublished(Field(&Twist2::turn, Gt(0.5))));
  rig.Set("first_direction", "right");
  rig.RunCycle();
  EXPECT_THAT(rig.module.twist.port, HasPublished(Field(&Twist2::turn, Lt(-0.5))));
}

TEST(EscapeTest, WaitsForProgressThenForAWayToTheGoal) {
  Rig<EscapeBehaviour> rig;
  rig.Feed("goal", Point2{5.0, 0.0});
  const auto stand = [&](int cycles) {
    for (; cycles > 0; --cycles) {
      rig.Feed("pose", Pose2{});
      rig.Feed("surroundings", WallAt(0.5, 0.0));
      rig.RunCycle();
    }
  };
  stand(79);
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.0)));
  stand(3);
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(1.0))) << "4 s have passed";
  rig.Feed("pose", Pose2{1.0, 0.0, 0.0});
  rig.RunCycle();
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(1.0))) << "nearer, and the way is not free";
  rig.Feed("surroundings", WallAt(0.5, kPi / 2));
  rig.RunCycle();
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.0)));
  EXPECT_THAT(rig.module.target_rating, HasPublished(TargetRating(0.0)));
}

TEST(EscapeTest, ItsGapsAreNoTimeWithoutProgress) {
  Rig<EscapeBehaviour> rig;
  rig.Feed("pose", Pose2{});
  rig.Feed("goal", Point2{5.0, 0.0});
  rig.Feed("surroundings", WallAt(0.5, 0.0));
  rig.RunCycles(5);
  rig.Wait(std::chrono::seconds(30));
  rig.Feed("pose", Pose2{});
  rig.Feed("surroundings", WallAt(0.5, 0.0));
  rig.RunCycles(2);
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.0)));
}

TEST(EscapeTest, IsNoDeadEndWhereTheRobotIsStopped) {
  Rig<EscapeBehaviour> rig;
  rig.Feed("goal", Point2{5.0, 0.0});
  const auto stand = [&](int cycles) {
    for (; cycles > 0; --cycles) {
      rig.Feed("pose", Pose2{});
      rig.Feed("surroundings", WallAt(0.5, 0.0));
      rig.RunCycle();
    }
    return rig.Last(rig.module.activity);
  };
  RobotStop& stop = rig.module.runtime().robot_stop();
  stop.Press("a test");
  EXPECT_EQ(stand(200), Activity(0.0));
  ASSERT_TRUE(stop.Release("a test"));
  EXPECT_EQ(stand(75), Activity(0.0));
  EXPECT_EQ(stand(10), Activity(1.0));
}

TEST(EscapeTest, RestsWhereDrivingIsContent) {
  Rig<EscapeBehaviour> rig;
  rig.Set("goal_tolerance", "0.3");
  rig.Feed("goal", Point2{0.2, 0.0});
  for (int i = 0; i < 100; ++i) {
    rig.Feed("pose", Pose2{});
    rig.Feed("surroundings", WallAt(0.5, 0.0));
    rig.RunCycle();
  }
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.0)));
}

TEST(EmergencyStopTest, StopsWhereItKnowsNothing) {
  Rig<EmergencyStopBehaviour> rig;
  rig.Feed("wanted", Twist2{0.4, 0.3});
  rig.RunCycle();
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(1.0))) << "no view has come";
  EXPECT_THAT(rig.module.target_rating, HasPublished(TargetRating(1.0)));
  EXPECT_THAT(rig.module.twist.port, HasPublished(Twist2{}));
  Surroundings view = WallAt(1.0, 0.0);
  rig.Feed("surroundings", view);
  rig.RunCycle();
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.0)));
  view.is_measured = false;
  rig.Feed("surroundings", view);
  rig.RunCycle();
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(1.0))) << "the view is not measured";
  EXPECT_THAT(rig.module.twist.port, HasPublished(Twist2{}));
}

TEST(EmergencyStopTest, StopsWhereItDoesNotKnowWhatTheOthersWant) {
  Rig<EmergencyStopBehaviour> rig;
  rig.Feed("surroundings", WallAt(1.0, 0.0));
  rig.RunCycle();
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(1.0)));
  EXPECT_THAT(rig.module.twist.port, HasPublished(Twist2{}));
}

TEST(RobotBehavioursTest, AreActiveInNothingWithoutAGoodView) {
  const auto check = [](auto&& rig) {
    if constexpr (requires { rig.module.pose; }) {
      rig.Feed("pose", Pose2{});
      rig.Feed("goal", Point2{5.0, 0.0});
    }
    Surroundings view = WallAt(0.4, 0.0);
    rig.Feed("surroundings", view);
    if constexpr (requires { rig.module.patience; }) rig.Set("patience", "0.1");
    rig.RunCycles(5);
    EXPECT_GT(rig.Last(rig.module.activity).value(), 0.0);
    view.is_measured = false;
    rig.Feed("surroundings", view);
    rig.RunCycle();
    EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.0))) << "it is not measured";
    view.is_measured = true;
    rig.Feed("surroundings", view);
    rig.RunCycle();
    EXPECT_GT(rig.Last(rig.module.activity).value(), 0.0);
    rig.RunCycles(12);
    EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.0))) << "it is old";
  };
  check(Rig<AvoidObstaclesBehaviour>());
  check(Rig<FollowWallBehaviour>());
  check(Rig<EscapeBehaviour>());
}

TEST(EmergencyStopTest, LetsNothingPassButTurning) {
  Rig<EmergencyStopBehaviour> rig;
  rig.Feed("surroundings", WallAt(0.31, 0.0));
  rig.Feed("wanted", Twist2{0.4, 0.3});
  rig.RunCycle();
  EXPECT_THAT(rig.module.twist.port, HasPublished(Twist2{0.0, 0.3}));
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(1.0)));
  rig.Feed("surroundings", WallAt(1.0, 0.0));
  rig.RunCycle();
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.0)));
  rig.RunCycles(12);
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(1.0))) << "nobody looks any more";
  EXPECT_THAT(rig.module.twist.port, HasPublished(Twist2{}));
}

TEST(RobotBehavioursTest, AllocateNothingInTheirCycles) {
  const auto run = [](auto&& rig) {
    if constexpr (requires { rig.module.pose; }) rig.Feed("pose", Pose2{});
    if constexpr (requires { rig.module.goal; }) rig.Feed("goal", Point2{5.0, 0.0});
    if constexpr (requires { rig.module.surroundings; }) rig.Feed("surroundings", WallAt(0.5, 0.2));
    if constexpr (requires { rig.module.wanted; }) rig.Feed("wanted", Twist2{0.4, 0.3});
    rig.RunCycles(20);
    EXPECT_THAT(rig, KeepsRealTime(100));
  };
  run(Rig<DriveToGoalBehaviour>());
  run(Rig<AvoidObstaclesBehaviour>());
  run(Rig<FollowWallBehaviour>());
  run(Rig<EscapeBehaviour>());
  run(Rig<EmergencyStopBehaviour>());
}

TEST(PlannerStatusTellerTest, SaysHowTheNetworkGetsOn) {
  ModuleRig<PlannerStatusTeller> rig;
  rig.Feed("pose", Pose2{});
  rig.Feed("goal", Point2{3.0, 4.0});
  rig.Feed("content", TargetRating(1.0));
  rig.RunCycle();
  EXPECT_THAT(rig.module.status, HasPublished(AllOf(Field(&PlannerStatus::mode, PlannerMode::kMotionToGoal),
                                                    Field(&PlannerStatus::distance_to_goal, 5.0))));
  rig.Feed("detour", Activity(1.0));
  rig.Feed("pose", Pose2{1.0, 0.0, 0.0});
  rig.RunCycle();
  EXPECT_THAT(rig.module.status,
              HasPublished(AllOf(Field(&PlannerStatus::mode, PlannerMode::kFollowingBoundary),
                                 Field(&PlannerStatus::path_length, 1.0), Field(&PlannerStatus::hits, 1u))));
  rig.Feed("detour", Activity(0.0));
  rig.Feed("content", TargetRating(0.0));
  rig.RunCycle();
  EXPECT_THAT(rig.module.status, HasPublished(AllOf(Field(&PlannerStatus::mode, PlannerMode::kReached),
                                                    Field(&PlannerStatus::leaves, 1u))));
  EXPECT_EQ(rig.Last(rig.module.points).leaves.size(), 1u);
}

TEST(PlannerStatusTellerTest, IsSilentOnceWhatItTellsOfIsOld) {
  ModuleRig<PlannerStatusTeller> rig;
  rig.Feed("goal", Point2{3.0, 4.0});
  const auto publishes = [&](const std::string& lost, int cycles) {
    std::uint64_t before = 0;
    for (; cycles > 0; --cycles) {
      before = rig.module.status.publications();
      if (lost != "pose") rig.Feed("pose", Pose2{});
      if (lost != "content") rig.Feed("content", TargetRating(1.0));
      if (lost != "detour") rig.Feed("detour", Activity(0.0));
      rig.RunCycle();
    }
    return rig.module.status.publications() > before;
  };
  for (const std::string lost : {"pose", "content", "detour"}) {
    EXPECT_TRUE(publishes("", 1)) << lost;
    EXPECT_TRUE(publishes(lost, 10)) << lost << ", for 0.5 s";
    EXPECT_FALSE(publishes(lost, 2)) << lost;
  }
}

}  // namespace
}  // namespace runnel

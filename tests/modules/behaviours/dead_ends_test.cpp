// A robot that takes something for a dead end which is none, or has been there before.

#include <gmock/gmock.h>

#include "modules/adaptors/algorithm/adaptors.h"
#include "modules/behaviours/algorithm/steering.h"
#include "tests/modules/planning/test_world.h"

namespace runnel {
namespace {

constexpr double kDriverStep = 0.05;

/// The network, without its emergency stop.
class Driver {
 public:
  Driver(const testing_world::World& world, const Pose2& pose) : world_(world), robot_(pose) {}

  /// Whether it is at its goal.
  bool Step(Point2 goal, bool is_held = false) {
    const Pose2 pose = robot_.pose();
    const Surroundings view = laser_.Update(world_.Scan(pose), pose);
    const bool is_escaping = WatchProgress({}, kDriverStep, pose, goal, view, escape);
    const Wish drive = DriveToGoal({}, {}, pose, goal), avoid = AvoidObstacles({}, {}, view);
    const double sum = 1.0 + avoid.rating;
    const Twist2 twist = is_escaping ? FollowWall({}, {}, view).twist
                                     : Twist2{(drive.twist.forward + avoid.rating * avoid.twist.forward) / sum,
                                              (drive.twist.turn + avoid.rating * avoid.twist.turn) / sum};
    robot_.Drive(is_held || drive.rating == 0.0 ? Twist2{} : twist, kDriverStep);
    return drive.rating == 0.0;
  }
  /// s, until it is there; 120 at most.
  double Drive(Point2 goal) {
    double time = 0.0;
    while (time < 120.0 && !Step(goal)) time += kDriverStep;
    return time;
  }
  void Carry(const Pose2& to) { robot_ = testing_world::Robot(to); }

  EscapeState escape;

 private:
  testing_world::World world_;
  testing_world::Robot robot_;
  LaserAdaptor laser_;
};

TEST(DeadEndTest, IsLeftAtOnceInTheOpen) {
  Driver driver({}, {0.0, 0.0, 0.75 * kPi});
  for (double time = 0.0; time < 5.0; time += kDriverStep) driver.Step({3.0, 0.0}, true);
  EXPECT_LT(driver.Drive({3.0, 0.0}), 15.0);
}

TEST(DeadEndTest, DoesNotLeadAwayWhereNoWallIs) {
  Surroundings view;
  view.is_measured = true;
  view.safe_distance = 0.35F;
  testing_world::Robot robot({});
  for (int step = 0; step < 4000; ++step) robot.Drive(FollowWall({}, {}, view).twist, kDriverStep);
  EXPECT_LT(Distance(Position(robot.pose()), {}), 1.5);
  const Twist2 left = FollowWall({}, {.first_turn = FirstTurn::kLeft}, view).twist;
  const Twist2 right = FollowWall({}, {.first_turn = FirstTurn::kRight}, view).twist;
  EXPECT_LT(left.turn, 0.0) << "the wall is to be on its right";
  EXPECT_EQ(right, (Twist2{left.forward, -left.turn}));
}

TEST(DeadEndTest, IsNoneWhereTheRobotWasAtItsGoalAndIsPushedAway) {
  Driver driver(testing_world::World({testing_world::Box(1.5, 2.0, 1.0, 1.0)}), {0.05, 0.0, 0.0});
  for (int step = 0; step < 20; ++step) EXPECT_TRUE(driver.Step({}));
  for (double x = 0.1; x < 4.0; x += 0.04) {  // in 5 s
    driver.Carry({x, 0.0, 0.3});
    driver.Step({}, true);
  }
  EXPECT_LT(driver.Drive({}), 30.0);
}

TEST(DeadEndTest, IsNoneWhereThePoseWasWrong) {
  Driver driver(testing_world::World({testing_world::Box(1.5, 2.0, 1.0, 1.0)}), {0.5, 0.0, 0.0});
  driver.Step({});
  driver.Carry({4.0, 0.0, 0.3});
  EXPECT_LT(driver.Drive({}), 15.0);
  EXPECT_EQ(driver.escape.stuck_distance, 0.0) << "nor was it taken for one";
}

// Nearer to its goal than it may come: nowhere is nearer by the margin.
TEST(DeadEndTest, IsLeftHalfWayToItsGoalWhereThatIsNear) {
  Surroundings view;
  view.is_measured = true;
  view.safe_distance = 0.35F;
  AddBoundaryPoint(view, {0.5, kPi});
  EscapeState state;
  for (int step = 0; step < 100; ++step) WatchProgress({}, kDriverStep, {0.25, 0.0, kPi}, {}, view, state);
  EXPECT_TRUE(state.is_escaping);
  EXPECT_FALSE(WatchProgress({}, kDriverStep, {0.12, 0.0, kPi / 2}, {}, view, state));
}

}  // namespace
}  // namespace runnel

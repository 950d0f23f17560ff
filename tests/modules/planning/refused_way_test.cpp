// A robot leaves its boundary for a point that it sees, and the way there proves to be blocked.

#include <gmock/gmock.h>

#include "tests/modules/planning/drive.h"

namespace runnel {
namespace {

using namespace testing_world;

/// A robot in a passage, which keeps its right side; TangentBug sees from `kSetOut` that it gets on at its end. It is put where
/// a test wants it, whatever it is told to do.
class RefusedWay : public testing::TestWithParam<bool> {
 protected:
  static constexpr double kHit = -0.16;     // m, where it hit the wall
  static constexpr double kSetOut = 0.0;    // m
  static constexpr double kBlocked = 0.80;  // m, where something shows that was not seen before
  static constexpr Point2 kGoal{5.0, 0.0};

  RefusedWay() {
    (void)algorithm.Update(state, InputAt({kHit, 0, 0}));
    state.status.mode = PlannerMode::kFollowingBoundary;
    state.status.hits = 1;
    state.status.hit_point = {kHit, 0};
    state.hit_distance = state.least_distance = kGoal.x - kHit;
    state.refused_at = state.status.path_length;
    state.lap.Start({kHit, 0, 0});
    state.follower.Start(BoundaryDirection::kLeft, {kHit, 0, 0}, -kPi / 2);
    for (double x = kHit; x < kSetOut; x += 0.04) (void)Put({x, 0, 0});
  }

  BugOutput Put(const Pose2& pose) { return algorithm.Update(state, InputAt(pose)); }
  void SetOut() {
    (void)Put({kSetOut, 0, 0});
    ASSERT_EQ(state.status.mode, PlannerMode::kGoingToLeavePoint);
    ASSERT_EQ(state.approach, Approach::kAcross);
  }
  void GoAcross() {
    for (double x = kSetOut; x < kBlocked; x += 0.04) (void)Put({x, 0, 0});
    is_blocked = true;
    (void)Put({kBlocked, 0, 0});
    ASSERT_EQ(state.approach, Approach::kBack);
  }
  void TurnLeft(double x, double from, double to) {
    for (double heading = from; heading < to + 0.01; heading += kPi / 12) (void)Put({x, 0, WrapAngle(heading)});
  }

  const BugAlgorithm algorithm = Make("tangent_bug");
  BugState state;
  double right_wall = 0.42;  // m
  double left_wall = 0.44;   // m
  bool is_blocked = false;

  [[nodiscard]] BugInput InputAt(const Pose2& pose) const {
    Surroundings surroundings;
    surroundings.is_measured = true;
    surroundings.is_vague = GetParam();
    surroundings.sensor_range = 2.0F;
    surroundings.safe_distance = 0.35F;
    const auto add = [&](Point2 point) {
      const Point2 seen = ToBody(pose, point);
      AddBoundaryPoint(surroundings, {Norm(seen), Direction(seen)});
    };
    for (double x = -1.1; x < 1.1; x += 0.01) {
      add({x, left_wall});
      add({x, -right_wall});
    }
    for (double y = -0.3; is_blocked && y < 0.3; y += 0.01) add({kBlocked + 0.36, y});
    return {kTimeStep, pose, surroundings, {kHit, 0}, kGoal};
  }
};

TEST_P(RefusedWay, LeadsBackToTheSideOfThePassageThatWasFollowed) {
  right_wall = 0.44;
  left_wall = 0.42;
  SetOut();
  GoAcross();
  TurnLeft(kBlocked, 0.0, kPi);
  (void)Put({kSetOut, 0, kPi});
  ASSERT_EQ(state.status.mode, PlannerMode::kFollowingBoundary);
  const auto contact = state.follower.ContactHeading(state.last_pose, {});
  ASSERT_TRUE(contact);
  EXPECT_LT(std::abs(WrapAngle(*contact + kPi / 2)), 0.2) << "it is the other side";
}

TEST_P(RefusedWay, IsNoPartOfTheLap) {
  SetOut();
  GoAcross();
  const double nearest = state.closest_distance;
  TurnLeft(kBlocked, 0.0, kPi);
  for (double x = kBlocked; x > kSetOut; x -= 0.04) (void)Put({x, 0, kPi});
  (void)Put({kSetOut, 0, kPi});
  TurnLeft(kSetOut, kPi, 2 * kPi);  // once round in all, near its hit point: no lap
  (void)Put({kSetOut + 0.04, 0, 0});
  EXPECT_EQ(state.status.mode, PlannerMode::kFollowingBoundary);
  EXPECT_LT(state.lap.length(), 0.3);
  EXPECT_NEAR(nearest, kGoal.x - kSetOut, 0.1) << "the way has come nearer to the goal than the boundary";
}

TEST_P(RefusedWay, IsGivenUpWhereTheRobotDoesNotGetOn) {
  for (const Approach approach : {Approach::kNear, Approach::kAlongBoundary, Approach::kAcross, Approach::kBack}) {
    const BugState before = state;
    SetOut();
    state.approach = approach;
    state.way_to_leave_point = 10.0;
    for (int step = 0; step < 1300; ++step) (void)Put({kSetOut + (step % 2 == 0 ? 0.05 : 0.0), 0, 0});
    EXPECT_EQ(state.status.mode, PlannerMode::kUnreachable) << static_cast<int>(approach);
    EXPECT_EQ(state.status.unreachability, Unreachability::kNoRoom);
    state = before;
  }
}

// What the one before has found on its lap is not what the other one would have.
TEST_P(RefusedWay, BeginsALapOfTheVariantThatTakesOver) {
  SetOut();
  EXPECT_GT(state.lap.length(), 0.1);
  (void)Make("dist_bug").Update(state, InputAt({kSetOut, 0, 0}));
  EXPECT_EQ(state.status.mode, PlannerMode::kGoingToLeavePoint);
  EXPECT_TRUE(state.leave_point);
  EXPECT_EQ(state.lap.length(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Sensors, RefusedWay, testing::Bool(),
                         [](const auto& vague) { return vague.param ? "Infrared" : "Laser"; });

}  // namespace
}  // namespace runnel

#include <cmath>
#include <limits>
#include <numbers>

#include "gmock/gmock.h"
#include "modules/planning/algorithm/driving.h"
#include "modules/planning/algorithm/faced_headings.h"
#include "modules/planning/algorithm/lap.h"
#include "modules/planning/algorithm/m_line.h"
#include "modules/planning/algorithm/wall_follower.h"
#include "modules/types/algorithm/surroundings.h"
#include "tests/modules/distances.h"

namespace runnel {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A straight wall at `distance` towards `bearing`, seen from the body's centre.
void AddWall(Surroundings& surroundings, double bearing, double distance) {
  for (int sector = 0; sector < Surroundings::kSectors; ++sector) {
    const double towards = std::cos(SectorBearing(sector) - bearing);
    if (towards > 0.05) AddBoundaryPoint(surroundings, {distance / towards, SectorBearing(sector)});
  }
}
Surroundings Open() {
  Surroundings surroundings;
  surroundings.sensor_range = 4.0F;
  surroundings.safe_distance = 0.35F;
  surroundings.is_measured = true;
  return surroundings;
}

TEST(Surroundings, KnowNothingAtFirst) {
  const Surroundings surroundings;
  EXPECT_FALSE(surroundings.is_measured);
  EXPECT_EQ(NearestBoundary(surroundings).distance, kInfinity);
  EXPECT_EQ(FreeRange(surroundings, 0.3, 0.3), kInfinity);
}

TEST(Surroundings, KeepTheNearestPointOfASector) {
  Surroundings surroundings;
  AddBoundaryPoint(surroundings, {2.0, 1.0});
  AddBoundaryPoint(surroundings, {1.0, 1.0});
  AddBoundaryPoint(surroundings, {3.0, 1.0});
  EXPECT_NEAR(NearestBoundary(surroundings).distance, 1.0, 1e-3);
  EXPECT_NEAR(NearestBoundary(surroundings).bearing, 1.0, kSectorWidth / 2);
}

TEST(Surroundings, LeaveOutWhatIsBeyondTheirMeasure) {
  Surroundings surroundings;
  AddBoundaryPoint(surroundings, {17.0, 0.0});
  AddBoundaryPoint(surroundings, {1.0, std::numeric_limits<double>::quiet_NaN()});
  AddBoundaryPoint(surroundings, {kInfinity, 0.0});
  AddBoundaryPoint(surroundings, {std::numeric_limits<double>::quiet_NaN(), 0.0});
  EXPECT_EQ(surroundings, Surroundings{});
}

TEST(Surroundings, TellFrontLeftAndRight) {
  Surroundings surroundings = Open();
  AddBoundaryPoint(surroundings, {0.3, 0.2});
  AddBoundaryPoint(surroundings, {0.5, kPi / 2 - 0.3});
  AddBoundaryPoint(surroundings, {0.2, kPi});
  EXPECT_NEAR(FrontDistance(surroundings), 0.3, 1e-3);
  EXPECT_NEAR(LeftDistance(surroundings), 0.5, 1e-3);
  EXPECT_EQ(RightDistance(surroundings), kInfinity);
}

TEST(Surroundings, LetADiscPassUntilItTouches) {
  Surroundings surroundings = Open();
  AddWall(surroundings, 0.0, 1.0);
  EXPECT_NEAR(FreeRange(surroundings, 0.0, 0.3), 0.7, 0.01);
  EXPECT_NEAR(FreeRange(surroundings, kPi / 3, 0.3), 1.4, 0.1);
  EXPECT_EQ(FreeRange(surroundings, kPi, 0.3), kInfinity);
  EXPECT_NEAR(LookAlong(surroundings, 0.0, 0.3).obstacle_bearing, 0.0, 2 * kSectorWidth);
}

TEST(Surroundings, LetADiscGoAwayFromAPointWithinIt) {
  Surroundings surroundings = Open();
  AddBoundaryPoint(surroundings, {0.2, 0.0});
  EXPECT_EQ(FreeRange(surroundings, 0.5, 0.3), 0.0);
  EXPECT_EQ(FreeRange(surroundings, 2.0, 0.3), kInfinity);
}

TEST(Surroundings, WrapBearingsIntoTheirSectors) {
  EXPECT_EQ(SectorOf(0.0), 0);
  EXPECT_EQ(SectorOf(2 * kPi), 0);
  EXPECT_EQ(SectorOf(-kSectorWidth), Surroundings::kSectors - 1);
  EXPECT_EQ(SectorOf(kPi), SectorOf(-kPi));
  for (int sector = 0; sector < Surroundings::kSectors; ++sector) {
    EXPECT_EQ(SectorOf(SectorBearing(sector)), sector);
  }
}

TEST(MLine, IsCrossedBetweenTwoSamples) {
  const MLine line({0, 0}, {4, 0});
  const auto crossing = line.Crossing({1, -0.2}, {1.2, 0.2});
  ASSERT_TRUE(crossing);
  EXPECT_NEAR(crossing->x, 1.1, 1e-12);
  EXPECT_NEAR(crossing->y, 0.0, 1e-12);
}

TEST(MLine, IsNotCrossedBeforeItsStartOrBeyondItsGoal) {
  const MLine line({0, 0}, {4, 0});
  EXPECT_FALSE(line.Crossing({-0.1, -1}, {-0.1, 1}));
  EXPECT_FALSE(line.Crossing({4.1, 1}, {4.1, -1}));
  EXPECT_FALSE(line.Crossing({1, 0.2}, {2, 0.1}));
}

TEST(MLine, CountsASampleOnTheLineOnce) {
  const MLine line({0, 0}, {4, 0});
  EXPECT_TRUE(line.Crossing({1, -0.2}, {1, 0}));
  EXPECT_FALSE(line.Crossing({1, 0}, {1, 0.2}));
}

TEST(MLine, LeadsBackToItselfAndEndsAtTheGoal) {
  const MLine line({0, 0}, {4, 0});
  EXPECT_NEAR(line.PointAhead({1, 0.3}, 0.4).x, 1.4, 1e-12);
  EXPECT_NEAR(line.PointAhead({1, 0.3}, 0.4).y, 0.0, 1e-12);
  EXPECT_EQ(line.PointAhead({3.9, 0.3}, 0.4), (Point2{4, 0}));
}

// Walks along a polygon with rounded corners: straight, then a turn on a small circle.
class Walker {
 public:
  explicit Walker(Lap& lap) : lap_(lap) { lap_.Start(pose_); }
  void Straight(double length) {
    for (double gone = 0; gone < length - 1e-9; gone += 0.02) Step(0.02, 0.0);
  }
  void Turn(double angle) {
    for (int i = 0; i < 20; ++i) Step(0.005, angle / 20);
  }
  [[nodiscard]] bool has_completed() const { return has_completed_; }
  [[nodiscard]] bool has_circled() const { return has_circled_; }

 private:
  void Step(double length, double turn) {
    pose_.heading = WrapAngle(pose_.heading + turn);
    const Point2 next = Position(pose_) + length * UnitVector(pose_.heading);
    pose_.x = next.x;
    pose_.y = next.y;
    lap_.Update(pose_);
    has_completed_ |= lap_.is_complete();
    has_circled_ |= lap_.is_circling();
  }
  Lap& lap_;
  Pose2 pose_;
  bool has_completed_ = false;
  bool has_circled_ = false;
};

TEST(Lap, IsCompleteAfterOnceRoundAndNotBefore) {
  for (const double sign : {1.0, -1.0}) {
    Lap lap;
    Walker walker(lap);
    for (int side = 0; side < 4; ++side) {
      EXPECT_FALSE(walker.has_completed());
      walker.Straight(3.0);
      walker.Turn(sign * kPi / 2);
    }
    walker.Straight(0.3);
    EXPECT_TRUE(walker.has_completed());
    EXPECT_NEAR(lap.length() - lap.gate_length(), 12.6, 0.3);
  }
}

TEST(Lap, IsNotCompletedByDithering) {
  Lap lap;
  Walker walker(lap);
  for (int i = 0; i < 20; ++i) {
    walker.Straight(0.5);
    walker.Turn(kPi);
    walker.Straight(0.5);
    walker.Turn(-kPi);
  }
  EXPECT_FALSE(walker.has_completed());
}

TEST(Lap, IsNotCompletedAlongTheOtherWallOfACorridor) {
  Lap lap;
  Walker walker(lap);
  walker.Straight(4.0);
  walker.Turn(kPi);
  walker.Straight(6.0);
  EXPECT_FALSE(walker.has_completed());
}

TEST(Lap, IsNotCompletedByTurningOnTheSpot) {
  Lap lap;
  Walker walker(lap);
  walker.Straight(0.2);
  for (int i = 0; i < 4; ++i) walker.Turn(kPi / 2);
  walker.Straight(0.1);
  EXPECT_FALSE(walker.has_completed());
}

TEST(Lap, SeesALoopThatTheStartIsNotOn) {
  Lap lap;
  Walker walker(lap);
  walker.Straight(2.0);
  for (int side = 0; side < 16; ++side) {
    walker.Straight(1.0);
    walker.Turn(kPi / 2);
  }
  EXPECT_FALSE(walker.has_completed());
  EXPECT_TRUE(walker.has_circled());
}

TEST(WallFollower, FirstTurnsTheBoundaryToItsHand) {
  Surroundings surroundings = Open();
  AddWall(surroundings, 0.0, 0.35);
  for (const auto direction : {BoundaryDirection::kLeft, BoundaryDirection::kRight}) {
    WallFollower follower;
    follower.Start(direction, {}, 0.0);
    const Twist2 twist = follower.Update({}, {}, surroundings, {});
    EXPECT_EQ(twist.forward, 0.0);
    EXPECT_GT(MirrorSign(direction) * twist.turn, 0.5);
    EXPECT_TRUE(follower.is_turning());
  }
}

TEST(WallFollower, TurnsAwayFromTheBoundaryEvenIfThatIsTheLongWay) {
  WallFollower follower;
  // The wall is on the left, but it is to be followed on the right: by nearly a whole half turn.
  follower.Start(BoundaryDirection::kLeft, {}, DegreesToRadians(100.0));
  EXPECT_GT(follower.Update({}, {}, Open(), {}).turn, 0.5);
}

// The twist when the boundary is already on the hand of a robot that turned left.
Twist2 Follow(const Surroundings& surroundings) {
  WallFollower follower;
  follower.Start(BoundaryDirection::kLeft, {}, -kPi / 2);
  return follower.Update({}, {}, surroundings, {});
}

TEST(WallFollower, GoesStraightAlongAWallAtTheSafeDistance) {
  Surroundings surroundings = Open();
  AddWall(surroundings, -kPi / 2, 0.35);
  const Twist2 twist = Follow(surroundings);
  EXPECT_GT(twist.forward, 0.2);
  EXPECT_NEAR(twist.turn, 0.0, 0.05);
}

TEST(WallFollower, CorrectsTheDistance) {
  Surroundings near_wall = Open(), far_wall = Open();
  AddWall(near_wall, -kPi / 2, 0.31);
  AddWall(far_wall, -kPi / 2, 0.42);
  EXPECT_GT(Follow(near_wall).turn, 0.2);
  EXPECT_LT(Follow(far_wall).turn, -0.2);
}

TEST(WallFollower, TurnsOnTheSpotInAConcaveCorner) {
  Surroundings surroundings = Open();
  AddWall(surroundings, -kPi / 2, 0.35);
  AddWall(surroundings, 0.0, 0.36);
  const Twist2 twist = Follow(surroundings);
  EXPECT_GT(twist.turn, 0.5);
  EXPECT_LT(twist.forward, 0.05);
}

// A wall on the right, and a boundary point ahead on the left that would make the robot turn away.
Surroundings WithSomethingAhead(bool is_vague, double heading = 0.0) {
  Surroundings surroundings = Open();
  surroundings.is_vague = is_vague;
  AddWall(surroundings, -kPi / 2 - heading, 0.35);
  AddBoundaryPoint(surroundings, {0.37, DegreesToRadians(-30.0) - heading});
  return surroundings;
}

TEST(WallFollower, FacesWhatMayBeThereBeforeItTurnsAway) {
  WallFollower follower;
  follower.Start(BoundaryDirection::kLeft, {}, -kPi / 2);
  FacedHeadings faced;
  faced.Start({});
  EXPECT_LT(follower.Update({}, {}, WithSomethingAhead(true), faced).turn, -0.5) << "not looked at";
  const Pose2 turned = {0.0, 0.0, DegreesToRadians(-30.0)};
  faced.Update(turned);
  const Surroundings as_before = WithSomethingAhead(true, turned.heading);
  EXPECT_GT(follower.Update({}, turned, as_before, faced).turn, 0.5) << "it is there";
}

TEST(WallFollower, TurnsAwayAtOnceFromWhatIsSurelyThere) {
  WallFollower follower;
  follower.Start(BoundaryDirection::kLeft, {}, -kPi / 2);
  FacedHeadings faced;
  faced.Start({});
  EXPECT_GT(follower.Update({}, {}, WithSomethingAhead(false), faced).turn, 0.5);
}

TEST(WallFollower, KeepsToItsSideOfAPassageWhereAnArcPushedItOff) {
  Surroundings passage = Open();
  AddBoundaryPoint(passage, {0.50, DegreesToRadians(-114.0)});
  AddBoundaryPoint(passage, {0.45, DegreesToRadians(33.0)});
  WallFollower follower;
  follower.Start(BoundaryDirection::kLeft, {}, -kPi / 2);
  EXPECT_NEAR(follower.Contact(passage).bearing, DegreesToRadians(33.0), 0.03);
  passage.is_vague = true;
  EXPECT_NEAR(follower.Contact(passage).bearing, DegreesToRadians(-114.0), 0.03);
}

TEST(FacedHeadings, GrowAsTheRobotTurnsOnTheSpot) {
  FacedHeadings faced;
  faced.Start({1.0, 2.0, 3.0});
  EXPECT_TRUE(faced.Contains(0.1));
  EXPECT_FALSE(faced.Contains(0.5));
  EXPECT_FALSE(faced.Contains(-0.5));
  faced.Update({1.0, 2.05, 3.5});  // past pi
  faced.Update({1.0, 2.05, 3.2});
  EXPECT_TRUE(faced.Contains(0.3));
  EXPECT_TRUE(faced.Contains(-0.2));
  EXPECT_FALSE(faced.Contains(0.6));
  EXPECT_FALSE(faced.Contains(-0.5));
  for (int i = 0; i < 10; ++i) faced.Update({1.0, 2.05, 3.2 + 0.6 * i});
  EXPECT_TRUE(faced.Contains(3.0)) << "a whole turn";
}

TEST(FacedHeadings, AreForgottenWhereTheRobotGetsOn) {
  FacedHeadings faced;
  faced.Start({});
  faced.Update({0.0, 0.0, 1.0});
  faced.Update({0.15, 0.0, 1.0});
  EXPECT_TRUE(faced.Contains(0.0));
  EXPECT_FALSE(faced.Contains(-1.0));
}

TEST(WallFollower, LooksForABoundaryThatIsLost) {
  EXPECT_GT(Follow(Open()).forward, 0.0);
  EXPECT_LT(Follow(Open()).turn, 0.0);
}

TEST(Driving, SlowsDownInFrontOfAnObstacle) {
  Surroundings surroundings = Open();
  const DrivingConfiguration configuration;
  EXPECT_EQ(DriveTowards(configuration, surroundings, 0.0, 0.4).forward, 0.4);
  AddWall(surroundings, 0.0, 0.40);
  const double slow = DriveTowards(configuration, surroundings, 0.0, 0.4).forward;
  EXPECT_LE(slow * slow / (2 * configuration.braking), 0.101);
  EXPECT_GT(slow, 0.0);
}

TEST(Driving, TurnsOnTheSpotTowardsWhatIsBeside) {
  const Twist2 twist = DriveTowards({}, Open(), -kPi / 2, 0.4);
  EXPECT_EQ(twist.forward, 0.0);
  EXPECT_LT(twist.turn, -0.5);
}

}  // namespace
}  // namespace runnel

// What infrared rangers do not see: what lies between their cones, and which boundary an echo belongs to.

#include <initializer_list>

#include <gmock/gmock.h>

#include "tests/modules/planning/drive.h"

namespace runnel {
namespace {

using namespace testing_world;

// What `runnel world --kind comb --seed 1006 --width 8 --height 8 --gap 0.9` makes.
Task Comb1006() {
  const Polygon comb = {{-2.506, -3.4}, {2.506, -3.4}, {2.506, 0.665},  {2.108, 0.665},
                        {2.108, -3},    {0.816, -3},   {0.816, 2.016},  {0.428, 2.016},
                        {0.428, -3},    {-0.572, -3},  {-0.572, 1.024}, {-0.889, 1.024},
                        {-0.889, -3},   {-2.171, -3},  {-2.171, 0.729}, {-2.506, 0.729}};
  return {World({comb}), {-4.306, -0.398}, {4.306, -0.409}};
}

// Round the end of a tooth the next corner comes up between the cones ahead and beside.
TEST(Unseen, IsNotDrivenInto) {
  for (const std::string_view variant : {"bug1", "rev1"}) {
    const Outcome outcome = Drive(variant, BoundaryDirection::kLeft, Sensor::kInfrared, Comb1006());
    EXPECT_EQ(int(outcome.status.mode), int(PlannerMode::kReached)) << variant;
    EXPECT_GT(outcome.least_clearance, 0.25) << variant;
  }
}

// A body that stands has looked ahead, to the left and to the right; to drive on it must know what is between.
TEST(Unseen, IsLookedAtBeforeTheFirstStep) {
  const BugAlgorithm algorithm = Make("bug2");
  Vehicle vehicle(World(), Sensor::kInfrared, {});
  BugState state;
  double turned = 0.0;
  for (int step = 0; step < 400 && vehicle.pose().x < 0.1; ++step) {
    const Pose2 pose = vehicle.pose();
    vehicle.Drive(algorithm.Update(state, {kTimeStep, pose, vehicle.Look(), {0, 0}, {5, 0}}).twist, kTimeStep);
    turned = std::max(turned, std::abs(pose.heading));
  }
  EXPECT_GE(vehicle.pose().x, 0.1);
  EXPECT_GT(turned, DegreesToRadians(30.0));
}

// The contour of a straight wall whose nearest point is `distance` m away, at `bearing`.
Surroundings VagueWall(double distance, double bearing) {
  Surroundings surroundings;
  surroundings.is_measured = surroundings.is_vague = true;
  surroundings.sensor_range = 2.0F;
  surroundings.safe_distance = 0.35F;
  for (int sector = 0; sector < Surroundings::kSectors; ++sector) {
    const double towards = std::cos(SectorBearing(sector) - bearing);
    if (towards > 0.1) AddBoundaryPoint(surroundings, {distance / towards, SectorBearing(sector)});
  }
  return surroundings;
}

// Whether a wall that goes on from ahead to beside the robot is its boundary beside it or that ahead must not change
// with each turn towards it.
TEST(InfraredFollower, TurnsAlongAWallAheadThatReachesToBesideIt) {
  Pose2 pose;
  FacedHeadings faced;
  faced.Start(pose);
  for (int degree = 0; degree <= 360; ++degree) faced.Update({0, 0, DegreesToRadians(degree)});  // all has been faced
  WallFollower follower;
  follower.Start(BoundaryDirection::kLeft, pose, DegreesToRadians(-90.0));
  Twist2 twist;
  for (int step = 0; step < 200 && twist.forward < 0.1; ++step) {
    twist = follower.Update({}, pose, VagueWall(0.426, DegreesToRadians(-10.0) - pose.heading), faced);
    pose.heading += kTimeStep * twist.turn;
  }
  EXPECT_GE(twist.forward, 0.1);
}

Surroundings VaguePoints(const Pose2& pose, std::initializer_list<Point2> points) {
  Surroundings surroundings = VagueWall(0.35, 0.0);
  surroundings.contour = Surroundings::NothingKnown();
  for (const Point2 point : points) {
    const Point2 local = ToBody(pose, point);
    AddBoundaryPoint(surroundings, {Norm(local), Direction(local)});
  }
  return surroundings;
}

// Led into a passage past the end of the wall it follows, the robot turns back towards that end, and the other side of
// the passage comes up behind it, nearer. Following that, it would turn round in front of an open passage.
TEST(InfraredFollower, KeepsToItsBoundaryWhenItHasTurnedTowardsIt) {
  const Point2 end_of_wall = 0.58 * UnitVector(DegreesToRadians(-138.0));
  const Point2 other_side = 0.38 * UnitVector(DegreesToRadians(86.0));
  Pose2 pose;
  FacedHeadings faced;
  faced.Start(pose);
  for (int degree = 0; degree <= 360; ++degree) faced.Update({0, 0, DegreesToRadians(degree)});  // all has been faced
  WallFollower follower;
  follower.Start(BoundaryDirection::kLeft, pose, DegreesToRadians(-90.0));
  for (int step = 0; step < 200; ++step) {
    const Twist2 twist = follower.Update({}, pose, VaguePoints(pose, {end_of_wall, other_side}), faced);
    pose.heading = WrapAngle(pose.heading + kTimeStep * twist.turn);
  }
  EXPECT_NEAR(follower.Contact(VaguePoints(pose, {end_of_wall, other_side})).distance, 0.58, 0.01);
}

// Where a wall has ended, the arc of a far echo from elsewhere may go on between the cones ahead and beside.
TEST(InfraredFollower, LooksAtWhatGoesOnFromABoundaryThatHasEnded) {
  FacedHeadings faced;
  faced.Start({});
  const auto twist_at = [&](const Surroundings& surroundings) {
    WallFollower follower;
    follower.Start(BoundaryDirection::kLeft, {}, DegreesToRadians(-90.0));
    return follower.Update({}, {}, surroundings, faced);
  };
  const Twist2 look = twist_at(VaguePoints({}, {0.35 * UnitVector(DegreesToRadians(-75.0))}));
  EXPECT_EQ(look.forward, 0.0);
  EXPECT_LT(look.turn, 0.0);
  EXPECT_GT(twist_at(VagueWall(0.35, DegreesToRadians(-75.0))).forward, 0.1) << "this one is beside it, too";
}

}  // namespace
}  // namespace runnel

// Which boundary an echo of infrared rangers belongs to.

#include <gmock/gmock.h>

#include "tests/modules/planning/drive.h"

namespace runnel {
namespace {

using testing_world::kTimeStep;

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

}  // namespace
}  // namespace runnel

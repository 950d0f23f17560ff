#include "modules/simulation/algorithm/physics_world.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/simulation/algorithm/world_geometry.h"
#include "modules/types/algorithm/angle.h"

namespace runnel {
namespace {

/// Wheel speeds for a motion, with the default robot's wheels.
WheelSpeeds Drive(double forward, double turn) {
  const RobotOptions robot;
  return {(forward - turn * robot.track / 2) / robot.wheel_radius,
          (forward + turn * robot.track / 2) / robot.wheel_radius};
}

constexpr double kRadius = RobotOptions{}.radius;

TEST(PhysicsWorld, StandsStillWithoutACommand) {
  PhysicsWorld world(World{.start = {1.0, 2.0, 0.5}});
  world.Advance(5.0);
  EXPECT_DOUBLE_EQ(world.pose().x, 1.0);
  EXPECT_DOUBLE_EQ(world.pose().y, 2.0);
  EXPECT_DOUBLE_EQ(world.pose().heading, 0.5);
  EXPECT_DOUBLE_EQ(world.elapsed(), 5.0);
  EXPECT_FALSE(world.contact().is_touching);
}

TEST(PhysicsWorld, DrivesStraightAlongItsHeading) {
  PhysicsWorld world(World{.start = {1.0, 2.0, 0.5}});
  world.SetWheelSpeeds(Drive(0.4, 0.0));
  world.Advance(1.0);  // the wheels need 0.2 s to bring 10 kg to 0.4 m/s with 20 N
  EXPECT_NEAR(world.twist().forward, 0.4, 1e-9);
  const Pose2 before = world.pose();
  world.Advance(10.0);
  const Pose2 after = world.pose();
  EXPECT_NEAR(after.x - before.x, 4.0 * std::cos(0.5), 1e-9);
  EXPECT_NEAR(after.y - before.y, 4.0 * std::sin(0.5), 1e-9);
  EXPECT_NEAR(after.heading, 0.5, 1e-9);
}

TEST(PhysicsWorld, TurnsOnTheSpot) {
  PhysicsWorld world(World{});
  world.SetWheelSpeeds(Drive(0.0, 1.0));
  world.Advance(1.0);
  const Pose2 before = world.pose();
  world.Advance(1.0);
  EXPECT_NEAR(WrapAngle(world.pose().heading - before.heading), 1.0, 1e-9);
  EXPECT_NEAR(world.twist().turn, 1.0, 1e-9);
  EXPECT_NEAR(world.pose().x, 0.0, 1e-9);
  EXPECT_NEAR(world.pose().y, 0.0, 1e-9);
}

}  // namespace
}  // namespace runnel

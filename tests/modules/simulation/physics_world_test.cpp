#include "modules/simulation/algorithm/physics_world.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <list>
#include <memory>
#include <string>
#include <thread>
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

TEST(PhysicsWorld, RemembersATouchUntilTheNextStep) {
  PhysicsWorld world(World{.boxes = {{.pose = {0.25, 0.0, 0.0}, .length = 0.2, .width = 1.0}}});
  world.SetWheelSpeeds(Drive(0.2, 0.0));
  world.Advance(1.0);
  ASSERT_TRUE(world.contact().is_touching);
  const double elapsed = world.elapsed();
  world.Advance(0.001);
  ASSERT_EQ(world.elapsed(), elapsed);
  EXPECT_TRUE(world.contact().is_touching);
}

TEST(PhysicsWorld, MakesUpForNoMoreThanTheLongestAdvance) {
  PhysicsOptions options;
  options.longest_advance = 2.0;
  PhysicsWorld world(World{}, options);
  world.Advance(3600.0);
  EXPECT_NEAR(world.elapsed(), 2.0, 1e-9);
  world.Advance(0.05);
  EXPECT_NEAR(world.elapsed(), 2.05, 1e-9);
}

TEST(PhysicsWorld, GoesOnAfterAMinuteWhenTheMachineWasSuspendedForAnHour) {
  PhysicsWorld world(World{});
  world.Advance(3600.0);
  EXPECT_NEAR(world.elapsed(), 60.0, 1e-6);
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

TEST(PhysicsWorld, DrivesAFullCircleBackToItsBeginning) {
  PhysicsWorld world(World{});
  world.SetWheelSpeeds(Drive(0.3, 0.5));
  world.Advance(1.0);
  const Pose2 begin = world.pose();
  world.Advance(2 * kPi);  // half a circle at 0.5 rad/s; its diameter is 2 * 0.3 / 0.5 m
  EXPECT_NEAR(Distance(Position(begin), Position(world.pose())), 1.2, 1e-4);
  world.Advance(2 * kPi);
  EXPECT_NEAR(Distance(Position(begin), Position(world.pose())), 0.0, 2e-3);
}

TEST(PhysicsWorld, NeverExceedsItsLimitsAndKeepsTheCurve) {
  PhysicsWorld world(World{});
  world.SetWheelSpeeds(Drive(5.0, 0.0));
  world.Advance(2.0);
  EXPECT_NEAR(world.twist().forward, 0.5, 1e-9);
  world.SetWheelSpeeds(Drive(-5.0, 0.0));
  world.Advance(2.0);
  EXPECT_NEAR(world.twist().forward, -0.5, 1e-9);
  world.SetWheelSpeeds(Drive(0.0, 40.0));
  world.Advance(2.0);
  EXPECT_NEAR(world.twist().turn, 1.5, 1e-9);
  world.SetWheelSpeeds(Drive(0.4, 3.0));  // twice as fast a turn as it may
  world.Advance(2.0);
  EXPECT_NEAR(world.twist().turn, 1.5, 1e-9);
  EXPECT_NEAR(world.twist().forward, 0.2, 1e-9);
}

TEST(PhysicsWorld, AcceleratesWithTheForceOfItsWheels) {
  PhysicsWorld world(World{});
  world.SetWheelSpeeds(Drive(0.5, 0.0));
  world.Advance(0.1);
  EXPECT_NEAR(world.twist().forward, 0.2, 1e-9);  // 20 N on 10 kg for 0.1 s
}

TEST(PhysicsWorld, StopsForNumbersThatAreNone) {
  PhysicsWorld world(World{});
  world.SetWheelSpeeds(Drive(0.5, 0.0));
  world.Advance(1.0);
  world.SetWheelSpeeds({std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()});
  world.Advance(1.0);
  EXPECT_NEAR(world.twist().forward, 0.0, 1e-9);
}

TEST(PhysicsWorld, AdvancesInWholeStepsAndForgetsNoTime) {
  PhysicsWorld world(World{});
  world.Advance(0.004);
  EXPECT_EQ(world.elapsed(), 0.0);
  world.Advance(0.004);
  EXPECT_EQ(world.elapsed(), 0.005);
  for (int i = 0; i < 1000; ++i) world.Advance(0.008);
  EXPECT_NEAR(world.elapsed(), 8.008, 0.005);
}

/// Every kind of obstacle with its face at x = 2, as seen from the origin.
struct Barrier {
  std::string name;
  World world;
};

std::vector<Barrier> Barriers() {
  const Ring square = {{2, -2}, {5, -2}, {5, 2}, {2, 2}};
  const Ring around = {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}};
  const Ring outer = {{-3, -3}, {3, -3}, {3, 3}, {-3, 3}};
  return {{"Box", {.boxes = {{.pose = {3, 0, 0}, .length = 2, .width = 4}}}},
          {"TurnedBox", {.boxes = {{.pose = {3, 0, kPi / 2}, .length = 4, .width = 2}}}},
          {"Cylinder", {.cylinders = {{.centre = {3, 0}, .radius = 1}}}},
          {"ThinWall", {.walls = {{.points = {{2.05, -2}, {2.05, 2}}, .thickness = 0.1}}}},
          {"EndOfAWall", {.walls = {{.points = {{2.05, 0}, {4, 0}}, .thickness = 0.1}}}},
          {"Polygon", {.polygons = {{.outline = square}}}},
          {"PolygonTheOtherWayRound", {.polygons = {{.outline = Ring(square.rbegin(), square.rend())}}}},
          {"HoleOfAPolygon", {.polygons = {{.outline = outer, .holes = {around}}}}},
          {"CornerOfAPolygon", {.polygons = {{.outline = {{2, 0}, {4, -2}, {4, 2}}}}}},
          {"Bounds", {.bounds = around}}};
}

class PhysicsWorldBarrier : public testing::TestWithParam<Barrier> {};

TEST_P(PhysicsWorldBarrier, StopsTheRobotAndIsFeltAhead) {
  PhysicsWorld world(GetParam().world);
  world.SetWheelSpeeds(Drive(0.5, 0.0));
  world.Advance(3.0);
  EXPECT_FALSE(world.contact().is_touching);
  world.Advance(5.0);
  EXPECT_NEAR(world.pose().x, 2.0 - kRadius, 2e-3);
  EXPECT_NEAR(world.pose().y, 0.0, 1e-2);
  EXPECT_NEAR(world.twist().forward, 0.0, 1e-2);
  EXPECT_TRUE(world.contact().is_touching);
  EXPECT_NEAR(world.contact().bearing, 0.0, 0.1);

  world.SetWheelSpeeds(Drive(-0.5, 0.0));
  world.Advance(2.0);
  world.Advance(0.1);
  EXPECT_LT(world.pose().x, 1.2);
  EXPECT_FALSE(world.contact().is_touching);
  EXPECT_EQ(world.contact().bearing, 0.0);
}

INSTANTIATE_TEST_SUITE_P(All, PhysicsWorldBarrier, testing::ValuesIn(Barriers()),
                         [](const auto& test) { return test.param.name; });

TEST(PhysicsWorld, FeelsAWallBehindAndToTheSideAtItsBearing) {
  PhysicsWorld behind(World{.walls = {{.points = {{-0.3, -2}, {-0.3, 2}}, .thickness = 0.1}}});
  behind.SetWheelSpeeds(Drive(-0.3, 0.0));
  behind.Advance(2.0);
  EXPECT_TRUE(behind.contact().is_touching);
  EXPECT_NEAR(std::abs(behind.contact().bearing), kPi, 0.1);

  // 45 degrees into a wall ahead: it is felt half right.
  PhysicsWorld oblique(World{.start = {0, 0, kPi / 4}, .walls = {{.points = {{1, -5}, {1, 5}}, .thickness = 0.1}}});
  oblique.SetWheelSpeeds(Drive(0.3, 0.0));
  oblique.Advance(5.0);
  EXPECT_TRUE(oblique.contact().is_touching);
  EXPECT_NEAR(oblique.pose().x, 0.95 - kRadius, 2e-3);
  EXPECT_NEAR(WrapAngle(oblique.pose().heading + oblique.contact().bearing), 0.0, 0.1);
}

TEST(PhysicsWorld, TurnsAwayFromAWallItStandsAt) {
  PhysicsWorld world(World{.walls = {{.points = {{1, -5}, {1, 5}}, .thickness = 0.1}}});
  world.SetWheelSpeeds(Drive(0.3, 0.0));
  world.Advance(5.0);
  world.SetWheelSpeeds(Drive(0.0, 1.0));
  world.Advance(3.0);
  EXPECT_GT(world.pose().heading, 2.0);
}

TEST(PhysicsWorld, PassesOverWhatIsLowerThanItsBody) {
  PhysicsWorld world(World{.boxes = {{.pose = {1, 0, 0}, .length = 1, .width = 1, .height = 0.01}}});
  world.SetWheelSpeeds(Drive(0.5, 0.0));
  world.Advance(10.0);
  EXPECT_GT(world.pose().x, 4.0);
}

World Clutter() {
  World world{.start = {0, 0, 0.3}, .bounds = Ring{{-2, -2}, {2, -2}, {2.5, 2}, {-2, 2}}};
  for (int i = 0; i < 8; ++i) {
    const double angle = i * kPi / 4;
    world.cylinders.push_back({.centre = 1.2 * UnitVector(angle), .radius = 0.12});
    world.boxes.push_back({.pose = {1.6 * std::cos(angle), 1.6 * std::sin(angle), angle}, .length = 0.2, .width = 0.4});
  }
  world.walls.push_back({.points = {{-0.6, -0.6}, {-0.6, 0.6}, {0, 0.7}}, .thickness = 0.05});
  return world;
}

std::vector<double> BumpAround(PhysicsWorld& world) {
  std::vector<double> history;
  for (int i = 0; i < 1200; ++i) {
    world.SetWheelSpeeds(Drive(i % 100 < 60 ? 0.5 : -0.3, i % 170 < 80 ? 0.9 : -0.4));
    world.Advance(0.05);
    const Pose2 pose = world.pose();
    const Contact contact = world.contact();
    history.insert(history.end(), {pose.x, pose.y, pose.heading, world.twist().forward, contact.is_touching ? 1.0 : 0.0,
                                   contact.bearing});
  }
  return history;
}

TEST(PhysicsWorld, RepeatsItselfToTheBit) {
  PhysicsWorld first(Clutter());
  const std::vector<double> expected = BumpAround(first);
  // Other blocks of memory in use: an order by address would show.
  const std::vector<std::unique_ptr<char[]>> ballast = [] {
    std::vector<std::unique_ptr<char[]>> blocks;
    for (std::size_t i = 1; i < 200; ++i) blocks.push_back(std::make_unique<char[]>(i * 37));
    return blocks;
  }();
  std::list<PhysicsWorld> worlds;
  for (int i = 0; i < 3; ++i) worlds.emplace_back(Clutter());
  for (auto world = worlds.rbegin(); world != worlds.rend(); ++world) {
    const std::vector<double> again = BumpAround(*world);
    ASSERT_EQ(again.size(), expected.size());
    EXPECT_EQ(std::memcmp(again.data(), expected.data(), again.size() * sizeof(double)), 0);
  }
}

TEST(PhysicsWorld, RepeatsItselfBesideOthersInOtherThreads) {
  PhysicsWorld alone(Clutter());
  const std::vector<double> expected = BumpAround(alone);
  std::vector<double> beside[2];
  std::vector<std::thread> threads;
  for (std::vector<double>& history : beside) {
    threads.emplace_back([&history] {
      PhysicsWorld world(Clutter());
      history = BumpAround(world);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(beside[0], expected);
  EXPECT_EQ(beside[1], expected);
}

TEST(PhysicsWorld, NeverGetsIntoAnythingWhileBumpingAround) {
  const World description = Clutter();
  PhysicsWorld world(description);
  const std::vector<double> history = BumpAround(world);
  int touches = 0;
  for (std::size_t i = 0; i < history.size(); i += 6) {
    EXPECT_GT(ClearanceAt(description, {history[i], history[i + 1]}), kRadius - 5e-3);
    touches += history[i + 4] != 0.0 ? 1 : 0;
  }
  EXPECT_GT(touches, 50);
}

}  // namespace
}  // namespace runnel

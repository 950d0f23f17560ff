// What rangers of narrow view have not looked at.

#include <cmath>

#include <gmock/gmock.h>

#include "modules/behaviours/algorithm/steering.h"
#include "modules/behaviours/robot_behaviours.h"
#include "plugins/testing/matchers.h"
#include "plugins/testing/module_rig.h"

namespace runnel {
namespace {

using test::HasPublished;
using test::ModuleRig;

constexpr double kUnseenBearing = SectorBearing(10);  // on the left

// Looked at `way` m ahead.
Surroundings UnseenAfter(double way, int sector = 10) {
  Surroundings view;
  view.is_measured = view.is_vague = true;
  view.sensor_range = 2.0F;
  view.safe_distance = 0.35F;
  view.unseen_sector = static_cast<std::uint8_t>(sector);
  view.unseen_after = static_cast<std::uint16_t>(way / Surroundings::kContourUnit);
  return view;
}

/// A robot that does what the emergency stop says.
struct LookingRobot {
  static constexpr double kTimeStep = 0.05;

  Twist2 Run(double way, const Twist2& wanted, int sector = 10) {
    const Twist2 twist = EmergencyStop(configuration, pose, UnseenAfter(way, sector), wanted, state).twist;
    pose.heading = WrapAngle(pose.heading + twist.turn * kTimeStep);
    pose.x += twist.forward * kTimeStep;
    return twist;
  }
  EmergencyStopConfiguration configuration;
  EmergencyStopState state;
  Pose2 pose;
};

TEST(EmergencyStopTest, HoldsALookUntilItFacesWhatNoRangerHasLookedAt) {
  LookingRobot robot;
  int looks = 0;
  // Whatever the others come to want while it turns, and whatever is unseen from there.
  while (looks < 100 && robot.Run(0.0, {looks % 2 == 0 ? 0.4 : 0.0, -0.1}, looks == 0 ? 10 : 110).turn > 0.0) ++looks;
  EXPECT_LT(looks, 100);
  EXPECT_NEAR(robot.pose.heading, kUnseenBearing, DegreesToRadians(10.0));
  EXPECT_EQ(robot.pose.x, 0.0);
}

TEST(EmergencyStopTest, CreepsIntoWhatItHasFacedFromThereAndNothingElse) {
  LookingRobot robot;
  for (int step = 0; step < 40; ++step) robot.Run(0.0, {0.4, 0.0}, step < 20 ? 10 : 0);
  EXPECT_NEAR(robot.Run(0.0, {0.4, 0.0}, 0).forward, 0.1, 1e-9) << "faced, and nothing can be told";
  const EmergencyStopState faced = robot.state;
  EXPECT_EQ(robot.Run(0.0, {0.4, 0.0}, 30).forward, 0.0) << "another direction";
  robot.state = faced;
  for (int step = 0; step < 12000; ++step) robot.Run(0.0, {0.0, 1.0});
  EXPECT_EQ(robot.Run(0.0, {0.4, 0.0}, 105).forward, 0.0) << "after ten minutes of turning";
  robot.state = faced;
  robot.pose.y += 1.0;
  EXPECT_EQ(robot.Run(0.0, {0.4, 0.0}, 0).forward, 0.0) << "carried elsewhere";
}

TEST(EmergencyStopTest, LooksHoweverLittleWayIsEnoughForIt) {
  LookingRobot robot;
  robot.configuration.least_way = 0.0;
  EXPECT_GT(robot.Run(0.0, {0.4, 0.0}).turn, 1.0);
}

TEST(EmergencyStopTest, SlowsDownBeforeWhatNoRangerHasLookedAtAndOnCurves) {
  LookingRobot robot;
  EXPECT_NEAR(robot.Run(0.15, {0.4, 0.0}).forward, 0.3, 1e-9);
  EXPECT_NEAR(robot.Run(0.3, {0.4, 1.2}).forward, DegreesToRadians(13.0) * 0.3 / 1.2, 1e-9);
  const Wish wish = EmergencyStop({}, {}, UnseenAfter(0.3), {0.2, 0.1}, robot.state);
  EXPECT_EQ(wish.twist, (Twist2{0.2, 0.1}));
  EXPECT_EQ(wish.rating, 0.0) << "slow enough";
}

TEST(EmergencyStopTest, NeedsToKnowWhereItIsWithRangersOfNarrowView) {
  ModuleRig<EmergencyStopBehaviour> rig;
  rig.Set("stimulation_mode", "enabled");
  rig.Feed("wanted", Twist2{0.2, 0.1});
  rig.Feed("surroundings", UnseenAfter(0.3));
  rig.RunCycle();
  EXPECT_THAT(rig.module.twist.port, HasPublished(Twist2{}));
  rig.Feed("pose", Pose2{});
  rig.RunCycle();
  EXPECT_THAT(rig.module.twist.port, HasPublished(Twist2{0.2, 0.1}));
}

}  // namespace
}  // namespace runnel

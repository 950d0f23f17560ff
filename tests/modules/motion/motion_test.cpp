#include <cmath>
#include <limits>

#include "gmock/gmock.h"
#include "modules/motion/algorithm/acceleration_limiter.h"
#include "modules/motion/algorithm/command_gate.h"
#include "modules/motion/algorithm/differential_drive.h"

namespace runnel {
namespace {

constexpr double kTolerance = 1e-12;

TEST(DifferentialDrive, GoesStraightWithEqualWheels) {
  const WheelSpeeds wheels = DifferentialDrive({.wheel_radius = 0.05}).ToWheels({0.2, 0.0});
  EXPECT_NEAR(wheels.left, 4.0, kTolerance);
  EXPECT_NEAR(wheels.right, 4.0, kTolerance);
}

TEST(DifferentialDrive, TurnsLeftWithTheRightWheelAhead) {
  const DifferentialDrive drive({.wheel_radius = 0.05, .track_width = 0.2});
  const WheelSpeeds wheels = drive.ToWheels({0.0, 1.0});
  EXPECT_NEAR(wheels.left, -2.0, kTolerance);
  EXPECT_NEAR(wheels.right, 2.0, kTolerance);
}

TEST(DifferentialDrive, ReturnsFromWheelsToTheSameMotion) {
  const DifferentialDrive drive;
  const Twist2 twist = drive.ToTwist(drive.ToWheels({0.31, -0.7}));
  EXPECT_NEAR(twist.forward, 0.31, kTolerance);
  EXPECT_NEAR(twist.turn, -0.7, kTolerance);
}

TEST(DifferentialDrive, KeepsTheCurvatureAtEveryLimit) {
  const DifferentialDrive drive({.wheel_radius = 0.05,
                                 .track_width = 0.25,
                                 .forward_limit = 0.5,
                                 .turn_limit = 1.5,
                                 .wheel_limit = 11.0});
  for (const Twist2 wanted :
       {Twist2{2.0, 0.5}, Twist2{0.3, 6.0}, Twist2{0.5, 1.5}, Twist2{-1, 2}}) {
    const Twist2 twist = drive.ToTwist(drive.ToWheels(wanted));
    EXPECT_NEAR(twist.turn / twist.forward, wanted.turn / wanted.forward, 1e-9);
    EXPECT_LE(std::abs(twist.forward), 0.5 + kTolerance);
    EXPECT_LE(std::abs(twist.turn), 1.5 + kTolerance);
  }
}

TEST(DifferentialDrive, LimitsTheFasterWheel) {
  const DifferentialDrive drive({.wheel_radius = 0.05, .track_width = 0.25, .wheel_limit = 11.0});
  const WheelSpeeds wheels = drive.ToWheels({0.5, 1.5});
  EXPECT_NEAR(wheels.right, 11.0, kTolerance);
  EXPECT_LT(wheels.left, wheels.right);
}

TEST(AccelerationLimiter, ReachesTheWantedMotionInTheTimeTheLimitsSay) {
  AccelerationLimiter limiter({.forward = 1.0, .turn = 4.0});
  EXPECT_NEAR(limiter.Update({0.5, -1.0}, 0.1).forward, 0.1, kTolerance);
  EXPECT_NEAR(limiter.Update({0.5, -1.0}, 0.1).turn, -0.8, kTolerance);
  EXPECT_NEAR(limiter.Update({0.5, -1.0}, 0.1).turn, -1.0, kTolerance);
  EXPECT_NEAR(limiter.Update({0.5, -1.0}, 0.3).forward, 0.5, kTolerance);
}

TEST(AccelerationLimiter, BrakesAsHardAsItAccelerates) {
  AccelerationLimiter limiter({.forward = 1.0, .turn = 4.0});
  limiter.Reset({0.5, 1.0});
  const Twist2 twist = limiter.Update({}, 0.1);
  EXPECT_NEAR(twist.forward, 0.4, kTolerance);
  EXPECT_NEAR(twist.turn, 0.6, kTolerance);
}

TEST(CommandGate, PassesFreshCommandsOnly) {
  const CommandGate gate(0.3);
  const Twist2 command = {0.4, 0.1};
  EXPECT_EQ(gate.Pass(command, 0.0, {}), command);
  EXPECT_EQ(gate.Pass(command, 0.3, {}), command);
  EXPECT_EQ(gate.Pass(command, 0.31, {}), Twist2{});
  EXPECT_EQ(gate.Pass(command, std::numeric_limits<double>::quiet_NaN(), {}), Twist2{});
}

TEST(CommandGate, StopsACommandThatIsNoNumber) {
  const double no_number = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(CommandGate().Pass({no_number, 0.1}, 0.0, {}), Twist2{});
  EXPECT_EQ(CommandGate().Pass({0.1, no_number}, 0.0, {}), Twist2{});
}

TEST(CommandGate, StandsStillWhileTouching) {
  EXPECT_EQ(CommandGate().Pass({0.4, 0.1}, 0.0, {.is_touching = true}), Twist2{});
}

}  // namespace
}  // namespace runnel

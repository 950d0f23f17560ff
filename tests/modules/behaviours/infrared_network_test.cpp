// The network of behaviours with infrared rangers in a world where its own emergency stop once drove it into a wall: it
// stood where two of its rules met, never faced what it looked at, and went on after a while.

#include <tuple>

#include <gmock/gmock.h>

#include "modules/adaptors/algorithm/adaptors.h"
#include "modules/behaviours/algorithm/steering.h"
#include "modules/simulation/algorithm/outline.h"
#include "modules/simulation/algorithm/range_sensors.h"
#include "modules/simulation/algorithm/ray_caster.h"
#include "modules/simulation/algorithm/world_geometry.h"
#include "modules/worlds/algorithm/world_generator.h"
#include "tests/modules/planning/test_world.h"

namespace runnel {
namespace {

constexpr double kTimeStep = 0.05;

/// A weighted average, and an emergency stop that wins.
class Network {
 public:
  Twist2 Run(const Surroundings& view, const Pose2& pose, Point2 goal) {
    const double part = IsUnseenNear(view) ? 0.25 : 1.0;  // of its time counts as being stuck while it looks
    const bool is_escaping = WatchProgress({}, part * kTimeStep, pose, goal, view, escape_);
    const Wish follow = FollowWall({}, {.first_turn = FirstTurn::kRight}, view);
    const Wish drive = DriveToGoal({}, {}, pose, goal), avoid = AvoidObstacles({}, {}, view);
    const double sum = 1.0 + avoid.rating;
    const Twist2 wanted = is_escaping ? follow.twist
                                      : Twist2{(drive.twist.forward + avoid.rating * avoid.twist.forward) / sum,
                                               (drive.twist.turn + avoid.rating * avoid.twist.turn) / sum};
    const double activity = is_escaping ? 1.0 : (1.0 + avoid.rating * avoid.rating) / sum;
    const Wish stop = EmergencyStop({}, pose, view, wanted, stop_);
    return stop.rating >= activity ? stop.twist : wanted;
  }

 private:
  EscapeState escape_;
  EmergencyStopState stop_;
};

class InfraredNetwork : public testing::TestWithParam<std::tuple<double, double>> {};

TEST_P(InfraredNetwork, TouchesNoWallAndArrives) {
  GeneratorOptions options;
  options.kind = WorldKind::kComb;
  options.seed = 1026;
  options.gap = 0.9;
  options.width = options.height = 8.0;
  const World world = GenerateWorld(options);
  const Outline outline = OutlineOf(world);
  const RayCaster rays(outline, 0.1);
  InfraredSensor rangers;
  InfraredAdaptor adaptor;
  Network network;
  Pose2 start = world.start;
  start.x += std::get<0>(GetParam());
  start.y += std::get<1>(GetParam());
  testing_world::Robot robot(start);
  double time = 0.0;
  for (; time < 300.0 && Distance(Position(robot.pose()), world.goal) >= 0.1; time += kTimeStep) {
    const Pose2 pose = robot.pose();
    ASSERT_GT(ClearanceAt(world, Position(pose)), testing_world::Robot::kRadius) << "after " << time << " s";
    robot.Drive(network.Run(adaptor.Update(rangers.Measure(rays, pose), pose), pose, world.goal), kTimeStep);
  }
  EXPECT_LT(time, 300.0);
}

INSTANTIATE_TEST_SUITE_P(Starts, InfraredNetwork,
                         testing::Combine(testing::Values(-0.02, -0.01, 0.0, 0.01, 0.02),
                                          testing::Values(-0.01, 0.0, 0.01)));

}  // namespace
}  // namespace runnel

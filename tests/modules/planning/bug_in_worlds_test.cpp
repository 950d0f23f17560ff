#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>

#include "gmock/gmock.h"
#include "modules/adaptors/algorithm/infrared_adaptor.h"
#include "modules/adaptors/algorithm/laser_adaptor.h"
#include "modules/planning/algorithm/bug1.h"
#include "modules/planning/algorithm/bug2.h"
#include "tests/modules/planning/test_world.h"

namespace runnel {
namespace {

using namespace testing_world;

constexpr double kTimeStep = 0.05;
constexpr int kMostSteps = 40000;

struct Outcome {
  PlannerStatus status;
  double least_clearance = 1e9;
  int steps = 0;
};

enum class Sensor { kLaser, kInfrared };

struct Task {
  World world;
  Point2 start;
  Point2 goal;
  double heading = 0.0;
};

// With RUNNEL_TRAJECTORIES=<folder> every run leaves its trajectory there, for a look at it.
class Trace {
 public:
  Trace() {
    const char* folder = std::getenv("RUNNEL_TRAJECTORIES");
    if (folder == nullptr) return;
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(test->test_suite_name()) + "." + test->name();
    for (char& c : name) c = c == '/' ? '_' : c;
    file_.open(std::string(folder) + "/" + name + ".txt");
  }
  void Write(const Pose2& pose, const BugOutput& out) {
    if (!file_.is_open()) return;
    file_ << pose.x << ' ' << pose.y << ' ' << pose.heading << ' ' << out.twist.forward << ' '
          << out.twist.turn << ' ' << int(out.status.mode) << ' ' << out.status.hits << ' '
          << out.status.leaves << '\n';
  }

 private:
  std::ofstream file_;
};

Outcome Drive(const BugAlgorithm& algorithm, Sensor sensor, const Task& task) {
  Robot robot({task.start.x, task.start.y, task.heading});
  LaserAdaptor laser;
  InfraredAdaptor infrared;
  BugState state;
  Outcome run;
  Trace trace;
  for (; run.steps < kMostSteps; ++run.steps) {
    const Pose2 pose = robot.pose();
    const Surroundings surroundings = sensor == Sensor::kLaser
                                          ? laser.Update(task.world.Scan(pose), pose)
                                          : infrared.Update(task.world.Infrared(pose), pose);
    const BugOutput out =
        algorithm.Update(state, {kTimeStep, pose, surroundings, task.start, task.goal});
    trace.Write(pose, out);
    run.status = out.status;
    run.least_clearance = std::min(run.least_clearance, task.world.Clearance(Position(pose)));
    if (out.status.mode == PlannerMode::kReached || out.status.mode == PlannerMode::kUnreachable) {
      break;
    }
    robot.Drive(out.twist, kTimeStep);
  }
  return run;
}

TEST(Slice, Bug2WithLaserGetsRoundABox) {
  const Task task{World({Box(0, 0, 1, 2)}), {-3, 0.2}, {3, 0.1}};
  const Outcome run = Drive(Bug2(BugConfiguration{}), Sensor::kLaser, task);
  std::printf("mode %d length %.2f clearance %.3f steps %d hits %u leaves %u\n",
              int(run.status.mode), run.status.path_length, run.least_clearance, run.steps,
              run.status.hits, run.status.leaves);
  EXPECT_EQ(run.status.mode, PlannerMode::kReached);
  EXPECT_GT(run.least_clearance, 0.25);
}

}  // namespace
}  // namespace runnel

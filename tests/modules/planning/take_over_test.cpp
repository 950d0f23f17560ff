// One variant takes over from another in the middle of a task.

#include <random>

#include <gmock/gmock.h>

#include "tests/modules/planning/drive.h"

namespace runnel {
namespace {

using namespace testing_world;

// A hook round the goal, a box before it: variants differ here in where they hit and leave.
Task HookWorld() {
  const Polygon hook = {{-1.5, -2}, {1.5, -2}, {1.5, 2}, {-1.5, 2}, {-1.5, 1.9}, {1.4, 1.9}, {1.4, -1.9}, {-1.5, -1.9}};
  return {World({hook, Box(-3.2, 0.3, 0.6, 1.0)}), {-5, 0.1}, {3, 0.2}};
}
Task WalledInWorld() { return {World({Box(0, 0, 3, 3), Box(0, 0, 2.8, 2.8)}), {-4, 0}, {0.3, 0.2}}; }

/// Drives with `first` for so many steps along boundaries, then with `second` to the end.
PlannerStatus DriveWithTakeOver(const Task& task, std::string_view first, std::string_view second,
                                int steps_at_boundary) {
  Vehicle vehicle(task.world, Sensor::kLaser, {task.start.x, task.start.y, 0.0});
  const BugAlgorithm before = Make(first), after = Make(second);
  BugState state;
  PlannerStatus status;
  double clearance = 1.0;
  for (int step = 0; step < kMostSteps; ++step) {
    const BugAlgorithm& now = steps_at_boundary > 0 ? before : after;
    const BugOutput out = now.Update(state, {kTimeStep, vehicle.pose(), vehicle.Look(), task.start, task.goal});
    status = out.status;
    if (status.mode == PlannerMode::kReached || status.mode == PlannerMode::kUnreachable) break;
    if (status.mode != PlannerMode::kMotionToGoal) --steps_at_boundary;
    vehicle.Drive(out.twist, kTimeStep);
    clearance = std::min(clearance, task.world.Clearance(Position(vehicle.pose())));
  }
  EXPECT_GT(clearance, 0.25);
  return status;
}

TEST(TakeOver, AnyVariantGoesOnWhereAnyOtherWas) {
  std::mt19937 dice(1);
  const Task task = HookWorld();
  for (const BugVariant& first : kBugVariants) {
    for (const BugVariant& second : kBugVariants) {
      // Com alone cannot get out of the hook.
      if (second.name == "com" || second.name == first.name) continue;
      const int moment = 20 + static_cast<int>(dice() % 700);
      const PlannerStatus status = DriveWithTakeOver(task, first.name, second.name, moment);
      EXPECT_EQ(int(status.mode), int(PlannerMode::kReached))
          << second.name << " after " << first.name << " at step " << moment;
    }
  }
}

TEST(TakeOver, NobodyIsLedToBelieveThatAWalledInGoalCanBeReached) {
  std::mt19937 dice(2);
  const Task task = WalledInWorld();
  for (const BugVariant& first : kBugVariants) {
    for (const char* second : {"bug1", "alg1", "dist_bug", "tangent_bug"}) {
      const int moment = 20 + static_cast<int>(dice() % 400);
      const PlannerStatus status = DriveWithTakeOver(task, first.name, second, moment);
      EXPECT_EQ(int(status.mode), int(PlannerMode::kUnreachable))
          << second << " after " << first.name << " at step " << moment;
      EXPECT_LT(status.path_length, 60.0);
    }
  }
}

// Bug1 has left the line from start to goal far behind it when Bug2 takes over: looking for the old
// line it would go round an obstacle that the line does not cross, and give up.
TEST(TakeOver, ALineVariantDrawsItsLineFromWhereTheObstacleWasHit) {
  const Task task = {World({Box(0, 0, 0.4, 6), Box(2.0, 4.2, 1.0, 1.0)}), {-2, 2.0}, {4, 4.6}};
  for (const char* second : {"bug2", "alg1", "rev1"}) {
    for (const int moment : {40, 200, 400, 600, 800}) {
      EXPECT_EQ(int(DriveWithTakeOver(task, "bug1", second, moment).mode), int(PlannerMode::kReached))
          << second << " at step " << moment;
    }
  }
}

TEST(TakeOver, IsNoNewTask) {
  const Task task = HookWorld();
  Vehicle vehicle(task.world, Sensor::kLaser, {task.start.x, task.start.y, 0.0});
  BugState state;
  const auto step = [&](const BugAlgorithm& algorithm) {
    const BugOutput out = algorithm.Update(state, {kTimeStep, vehicle.pose(), vehicle.Look(), task.start, task.goal});
    vehicle.Drive(out.twist, kTimeStep);
    return out.status;
  };
  const BugAlgorithm alg2 = Make("alg2"), class1 = Make("class1");
  PlannerStatus before;
  while (before.hits == 0) before = step(alg2);
  for (int i = 0; i < 50; ++i) before = step(alg2);
  const PlannerStatus after = step(class1);
  EXPECT_EQ(after.hits, before.hits);
  EXPECT_EQ(after.hit_point, before.hit_point);
  EXPECT_EQ(after.mode, before.mode);
  EXPECT_GE(after.path_length, before.path_length);
  EXPECT_EQ(state.hits.size(), 1u);
}

}  // namespace
}  // namespace runnel

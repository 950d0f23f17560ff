#include <random>

#include "gmock/gmock.h"
#include "tests/modules/planning/drive.h"

namespace runnel {
namespace {

using namespace testing_world;

// Drives with a laser and lets a test look at every step.
class Session {
 public:
  Session(const World& world, Point2 start, Point2 goal)
      : world_(world), start_(start), goal_(goal), robot_({start.x, start.y, 0.0}) {}

  BugOutput Step(const BugAlgorithm& algorithm) {
    const Pose2 pose = robot_.pose();
    const BugOutput out =
        algorithm.Update(state, {kTimeStep, pose, laser_.Update(world_.Scan(pose), pose), start_, goal_});
    robot_.Drive(out.twist, kTimeStep);
    return out;
  }
  /// Until the predicate holds for the status.
  template <typename Predicate>
  BugOutput StepUntil(const BugAlgorithm& algorithm, Predicate predicate) {
    BugOutput out;
    for (int step = 0; step < 5000; ++step) {
      out = Step(algorithm);
      if (predicate(out.status)) return out;
    }
    ADD_FAILURE() << "never happened";
    return out;
  }
  void SetGoal(Point2 goal) { goal_ = goal; }
  /// Whoever holds the robot lets go with it at rest.
  void Stop() { robot_ = Robot(robot_.pose()); }
  [[nodiscard]] Surroundings Look() { return laser_.Update(world_.Scan(pose()), pose()); }
  [[nodiscard]] const Pose2& pose() const { return robot_.pose(); }

  BugState state;

 private:
  World world_;
  Point2 start_;
  Point2 goal_;
  Robot robot_;
  LaserAdaptor laser_;
};

bool IsFinished(const PlannerStatus& status) {
  return status.mode == PlannerMode::kReached || status.mode == PlannerMode::kUnreachable;
}
bool HasHit(const PlannerStatus& status) { return status.hits > 0; }
bool HasLeft(const PlannerStatus& status) { return status.leaves > 0; }

World BoxWorld() { return World({Box(0, 0, 1, 2)}); }

TEST(BugRules, DrivesOnNoCurveWhereNarrowRangersHaveNotLooked) {
  for (const bool is_vague : {false, true}) {
    Surroundings open;
    open.is_measured = true;
    open.is_vague = is_vague;
    open.sensor_range = 2.0F;
    open.safe_distance = 0.35F;
    BugState state;
    const BugInput input = {kTimeStep, {}, open, {0, 0}, {3.0, 1.5}};
    const Twist2 twist = Make("tangent_bug").Update(state, input).twist;
    EXPECT_GT(twist.turn, 0.5);
    EXPECT_EQ(twist.forward == 0.0, is_vague);
  }
}

TEST(BugRules, StandsStillWhileNothingWasMeasured) {
  BugState state;
  const BugOutput out = Make("bug2").Update(state, {kTimeStep, {}, Surroundings{}, {0, 0}, {3, 0}});
  EXPECT_EQ(out.twist, Twist2{});
  EXPECT_EQ(out.status.mode, PlannerMode::kMotionToGoal);
}

TEST(BugRules, DoesNotTakeSilentSensorsForLackOfRoom) {
  Session session(BoxWorld(), {-3, 0.2}, {3, 0.1});
  const BugAlgorithm bug = Make("bug2");
  session.StepUntil(bug, HasHit);
  for (int step = 0; step < 1000; ++step) {
    (void)bug.Update(session.state, {kTimeStep, session.pose(), {}, {-3, 0.2}, {3, 0.1}});
  }
  EXPECT_EQ(session.StepUntil(bug, IsFinished).status.mode, PlannerMode::kReached);
}

TEST(BugRules, IsThereAtOnceIfItStartsThere) {
  Session session(World{}, {0, 0}, {0.05, 0});
  EXPECT_EQ(session.Step(Make("bug1")).status.mode, PlannerMode::kReached);
}

TEST(BugRules, StandsStillAfterTheVerdict) {
  Session session(World{}, {0, 0}, {1, 0});
  const BugAlgorithm bug = Make("bug2");
  session.StepUntil(bug, IsFinished);
  EXPECT_EQ(session.Step(bug).twist, Twist2{});
}

TEST(BugRules, ANewGoalIsANewTask) {
  Session session(World{}, {0, 0}, {1, 0});
  const BugAlgorithm bug = Make("bug2");
  session.StepUntil(bug, IsFinished);
  session.SetGoal({1, 2});
  EXPECT_EQ(session.Step(bug).status.mode, PlannerMode::kMotionToGoal);
  const PlannerStatus status = session.StepUntil(bug, IsFinished).status;
  EXPECT_EQ(status.mode, PlannerMode::kReached);
  EXPECT_LT(status.path_length, 2.6);
}

TEST(BugRules, HitsAtTheSafeDistance) {
  Session session(BoxWorld(), {-3, 0.2}, {3, 0.1});
  const PlannerStatus status = session.StepUntil(Make("bug2"), HasHit).status;
  EXPECT_NEAR(status.hit_point.x, -0.85, 0.03);
}

TEST(BugRules, Bug2LeavesOnTheMLine) {
  Session session(BoxWorld(), {-3, 0.2}, {3, 0.1});
  const PlannerStatus status = session.StepUntil(Make("bug2"), HasLeft).status;
  EXPECT_LT(Distance(Segment2{{-3, 0.2}, {3, 0.1}}, status.leave_point), 0.05);
  EXPECT_NEAR(status.leave_point.x, 0.85, 0.08);
}

TEST(BugRules, DoesNotHitTheWallItJustLeft) {
  for (const BugVariant& variant : kBugVariants) {
    Session session(BoxWorld(), {-3, 0.2}, {3, 0.1});
    const auto bug = Make(variant.name);
    const PlannerStatus status = session.StepUntil(bug, IsFinished).status;
    // TangentBug drives past the box without following it.
    EXPECT_EQ(status.hits, variant.name == "tangent_bug" ? 0U : 1U) << variant.name;
    EXPECT_EQ(status.leaves, status.hits) << variant.name;
  }
}

TEST(BugRules, Bug1LeavesAtTheNearestPointOfTheBoundary) {
  Session session(BoxWorld(), {-3, 0.2}, {3, 0.5});
  const PlannerStatus status = session.StepUntil(Make("bug1"), HasLeft).status;
  EXPECT_LT(Distance(status.leave_point, {0.85, 0.5}), 0.12);
}

// The goal lies to the left or right of a long wall's middle, so the leave point lies early or late
// in the lap: the way back to it must be the shorter one both times.
TEST(BugRules, Bug1GoesBackTheShorterWay) {
  for (const double side : {1.5, -1.5}) {
    Session session(World({Box(0, 0, 0.4, 4)}), {-2, 0}, {2, side});
    const BugAlgorithm bug = Make("bug1");
    const double lap = session.StepUntil(bug, [](const auto& s) { return s.mode == PlannerMode::kGoingToLeavePoint; })
                           .status.path_length;
    const double back = session.StepUntil(bug, HasLeft).status.path_length - lap;
    const double perimeter = lap - 1.45;
    EXPECT_LT(back, 0.5 * perimeter);
    EXPECT_GT(back, 0.2 * perimeter);
  }
}

TEST(BugRules, TurnsTheWayItIsTold) {
  for (const auto direction : {BoundaryDirection::kLeft, BoundaryDirection::kRight}) {
    Session session(BoxWorld(), {-3, 0.2}, {3, 0.1});
    const auto bug = Make("bug2", direction);
    session.StepUntil(bug, HasHit);
    for (int step = 0; step < 80; ++step) session.Step(bug);
    EXPECT_GT(MirrorSign(direction) * (session.pose().y - 0.2), 0.3);
  }
}

TEST(BugRules, OneVariantTakesOverFromAnotherInTheMiddleOfALap) {
  Session session(BoxWorld(), {-3, 0.2}, {3, 0.1});
  const BugAlgorithm bug1 = Make("bug1");
  session.StepUntil(bug1, HasHit);
  for (int step = 0; step < 100; ++step) session.Step(bug1);
  const PlannerStatus status = session.StepUntil(Make("bug2"), IsFinished).status;
  EXPECT_EQ(status.mode, PlannerMode::kReached);
  EXPECT_EQ(status.leaves, 1U);
  EXPECT_LT(status.path_length, 9.0);
}

// The paper's period, with speeds to match.
TEST(BugRules, AStepOfHalfASecondIsEnoughForASlowRobot) {
  const Task task = {World({Box(0, 0, 1, 2)}), {-2, 0.2}, {2, 0.1}};
  BugConfiguration slow;
  slow.driving.cruise_speed = 0.1;
  slow.driving.following_speed = 0.1;
  slow.driving.turn_limit = 0.4;
  slow.driving.turn_gain = 1.4;
  for (const BugVariant& variant : VariantsThatEnd()) {
    for (const Sensor sensor : {Sensor::kLaser, Sensor::kInfrared}) {
      const BugAlgorithm algorithm(slow, Assemble(variant.composition));
      Vehicle vehicle(task.world, sensor, {task.start.x, task.start.y, 0.0});
      BugState state;
      PlannerStatus status;
      double clearance = 1.0;
      for (int step = 0; step < 2000 && !IsFinished(status); ++step) {
        const BugOutput out = algorithm.Update(state, {0.5, vehicle.pose(), vehicle.Look(), task.start, task.goal});
        status = out.status;
        vehicle.Drive(out.twist, 0.5);
        clearance = std::min(clearance, task.world.Clearance(Position(vehicle.pose())));
      }
      EXPECT_EQ(int(status.mode), int(PlannerMode::kReached)) << variant.name;
      EXPECT_GT(clearance, 0.22) << variant.name;
    }
  }
}

TEST(BugRules, IsThereAtOnceIfItStartsThereWhateverTheVariant) {
  for (const BugVariant& variant : kBugVariants) {
    Session session(BoxWorld(), {-2, 0}, {-2, 0});
    EXPECT_EQ(session.Step(Make(variant.name)).status.mode, PlannerMode::kReached) << variant.name;
  }
}

TEST(BugRules, DoesNotTakeBeingHeldForLackOfRoom) {
  std::mt19937 dice;
  const auto noise = [&](double most) { return most * (2.0 * static_cast<double>(dice()) / 4294967295.0 - 1.0); };
  for (const double most : {0.0, 0.0003, 0.001, 0.01}) {  // m and rad
    for (const bool is_at_wall : {false, true}) {
      Session session(BoxWorld(), {-3, 0.2}, {3, 0.1});
      const BugAlgorithm bug = Make("bug2");
      if (is_at_wall) session.StepUntil(bug, HasHit);
      for (int step = 0; step < 50; ++step) session.Step(bug);
      session.Stop();
      const Surroundings view = session.Look();
      for (int step = 0; step < 2000; ++step) {  // a gate lets no command pass for 100 s
        const Pose2 pose = session.pose();
        const Pose2 noisy = {pose.x + noise(most), pose.y + noise(most), pose.heading + noise(most)};
        (void)bug.Update(session.state, {kTimeStep, noisy, view, {-3, 0.2}, {3, 0.1}});
      }
      const PlannerStatus status = session.StepUntil(bug, IsFinished).status;
      EXPECT_EQ(status.mode, PlannerMode::kReached) << most << ' ' << is_at_wall;
      EXPECT_EQ(status.hits, 1u) << most << ' ' << is_at_wall;
    }
  }
}

TEST(BugRules, DoesNotTakeBeingHeldForLackOfRoomHoweverSlowItIs) {
  for (const double speed : {0.1, 0.05, 0.02}) {
    for (const char* const variant : {"bug2", "tangent_bug"}) {
      SCOPED_TRACE(std::string(variant) + " at " + std::to_string(speed) + " m/s");
      BugConfiguration slow;
      slow.driving.cruise_speed = slow.driving.following_speed = speed;
      const BugAlgorithm bug(slow, Assemble(kBugVariants.at(VariantIndex(variant)).composition));
      Session session(BoxWorld(), {-3, 0.2}, {3, 0.1});
      for (int step = 0; step < 40; ++step) session.Step(bug);
      session.Stop();
      const Surroundings view = session.Look();
      PlannerStatus status;
      for (int step = 0; step < 2000; ++step)
        status = bug.Update(session.state, {kTimeStep, session.pose(), view, {-3, 0.2}, {3, 0.1}}).status;
      EXPECT_EQ(status.mode, PlannerMode::kMotionToGoal);
      EXPECT_EQ(status.hits, 0u);
    }
  }
}

// Straight behind it is where the sign of a bearing wavers with the pose.
TEST(BugRules, DoesNotTakeBeingHeldForLackOfRoomWithTheGoalBehind) {
  std::mt19937 dice;
  const auto noise = [&] { return 0.01 * (2.0 * static_cast<double>(dice()) / 4294967295.0 - 1.0); };  // m and rad
  for (const bool is_vague : {false, true}) {
    for (const char* const variant : {"bug1", "bug2", "tangent_bug", "dist_bug"}) {
      SCOPED_TRACE(std::string(variant) + (is_vague ? ", vague" : ""));
      const BugAlgorithm bug = Make(variant);
      Session session(World({Box(0, 5, 1, 1)}), {3, 0}, {-3, 0});
      Surroundings view = session.Look();
      view.is_vague = is_vague;
      PlannerStatus status;
      for (int step = 0; step < 2000; ++step) {
        const Pose2 pose = {3 + noise(), noise(), noise()};
        status = bug.Update(session.state, {kTimeStep, pose, view, {3, 0}, {-3, 0}}).status;
      }
      EXPECT_EQ(status.mode, PlannerMode::kMotionToGoal);
      EXPECT_EQ(status.hits, 0u);
    }
  }
}

TEST(BugRules, FindsLackOfRoomAlsoOnceItHasBeenHeld) {
  Session session(World({Box(0, 0, 0.62, 0.62)}), {0, 0}, {3, 0});
  const BugAlgorithm bug = Make("bug2");
  for (int step = 0; step < 100; ++step) session.Step(bug);
  session.Stop();
  const Surroundings view = session.Look();
  for (int step = 0; step < 400; ++step)
    (void)bug.Update(session.state, {kTimeStep, session.pose(), view, {0, 0}, {3, 0}});
  EXPECT_EQ(session.StepUntil(bug, IsFinished).status.unreachability, Unreachability::kNoRoom);
}

TEST(BugRules, GivesTheSameCommandsForTheSameMeasurements) {
  Session first(BoxWorld(), {-3, 0.2}, {3, 0.1}), second(BoxWorld(), {-3, 0.2}, {3, 0.1});
  const BugAlgorithm bug = Make("bug1");
  for (int step = 0; step < 600; ++step) ASSERT_EQ(first.Step(bug).twist, second.Step(bug).twist);
}

TEST(BugRules, TellsWhyAGoalIsUnreachable) {
  Session session(World({Box(0, 0, 0.62, 0.62)}), {0, 0}, {3, 0});
  const PlannerStatus status = session.StepUntil(Make("bug2"), IsFinished).status;
  EXPECT_EQ(status.unreachability, Unreachability::kNoRoom);
  Session other(World({Box(0, 0, 3, 3)}), {0, 0}, {3, 0});
  EXPECT_EQ(other.StepUntil(Make("bug2"), IsFinished).status.unreachability, Unreachability::kEnclosed);
}

}  // namespace
}  // namespace runnel

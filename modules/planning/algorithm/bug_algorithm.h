#pragma once

#include <optional>

#include "modules/planning/algorithm/bug_state.h"
#include "modules/planning/algorithm/driving.h"

namespace runnel {

struct BugConfiguration {
  DrivingConfiguration driving;
  BoundaryDirection first_direction = BoundaryDirection::kLeft;
  double goal_tolerance = 0.10;  ///< m; nearer than this is there
  /// m by which a leave point must be nearer to the goal than what it is compared with: above the
  /// noise of localisation.
  double leave_margin = 0.10;
  double hit_range = 0.05;    ///< m; the way to the goal free for less than this is a hit
  double leave_range = 0.10;  ///< m; a leave point must be free towards the goal for this
  double idle_limit = 15.0;   ///< s; without getting on for so long there is no room to move
};

struct BugOutput {
  Twist2 twist;
  PlannerStatus status;
};

/// The generic Bug algorithm of "On the variability of Bug algorithms" as a template method: Update
/// is its algorithm 2, and the hooks bear its names. Where the paper asks in each call whether an
/// obstacle is in front (and would forget the boundary as soon as the robot has turned along it),
/// here the mode is state.
///
/// Objects hold a configuration only; what is remembered is in the BugState that the caller owns,
/// so variants can be exchanged between two updates. Everything happens in the plane of the body's
/// centre, with obstacles grown by the safe distance. Update does not allocate and is
/// deterministic.
class BugAlgorithm {
 public:
  explicit BugAlgorithm(const BugConfiguration& configuration) : configuration_(configuration) {}
  virtual ~BugAlgorithm() = default;

  /// One step. Standstill while the surroundings are unknown, and after a verdict.
  [[nodiscard]] BugOutput Update(BugState& state, const BugInput& input) const;

  [[nodiscard]] const BugConfiguration& configuration() const { return configuration_; }

 protected:
  /// findLeavePoint: called once for each step along a boundary, may set state.leave_point.
  virtual void FindLeavePoint(BugState& state, const BugInput& input) const = 0;
  /// researchComplete: whether to stop looking for (better) leave points.
  virtual bool ResearchComplete(const BugState& state) const = 0;
  /// goToLeavePoint: nothing once the robot is there.
  virtual std::optional<Twist2> GoToLeavePoint(BugState& state, const BugInput& input) const = 0;
  /// The robot is at its leave point and sees that the way to the goal is not free.
  virtual void RefuseLeavePoint(BugState& state, const BugInput& input) const = 0;
  /// The point that motion to goal steers at.
  virtual Point2 MotionTarget(const BugInput& input) const { return input.goal; }
  /// leavePointFound
  virtual bool LeavePointFound(const BugState& state) const;
  /// completeCycleAroundObstacle
  virtual bool CompleteCycleAroundObstacle(const BugState& state) const;
  /// goalReached
  virtual bool GoalReached(const BugState& state) const;

  // What hooks are made of.
  /// m; a robot nearer than this to its leave point is there.
  static constexpr double kLeavePrecision = 0.05;
  /// Whether the straight way to the goal is free for at least the leave range, or to the goal.
  [[nodiscard]] bool FreeTowardsGoal(const BugInput& input) const;
  /// wallFollowing(direction)
  [[nodiscard]] Twist2 WallFollowing(BugState& state, const BugInput& input) const;
  /// Takes up the boundary nearest to the robot, in the direction given.
  void StartFollowing(BugState& state, const BugInput& input, BoundaryDirection direction) const;
  /// Straight to a point nearby; nothing once within `tolerance` m, or if the way there is not
  /// free.
  [[nodiscard]] std::optional<Twist2> DriveToPoint(const BugInput& input, Point2 point,
                                                   double tolerance) const;
  /// From here all round once more, as if the obstacle had been hit here.
  void RestartLap(BugState& state, const BugInput& input) const;
  void GiveUp(BugState& state, Unreachability reason) const;

 private:
  void Begin(BugState& state, const BugInput& input) const;
  void Record(BugState& state, const BugInput& input) const;
  Twist2 Step(BugState& state, const BugInput& input) const;
  Twist2 MotionToGoal(BugState& state, const BugInput& input) const;
  Twist2 IdentifyLeavePoint(BugState& state, const BugInput& input) const;
  Twist2 FinishFruitlessLap(BugState& state, const BugInput& input) const;
  Twist2 MoveToLeavePoint(BugState& state, const BugInput& input) const;
  Twist2 FaceGoal(BugState& state, const BugInput& input) const;
  Twist2 GoAhead(const BugState& state, const BugInput& input, double bearing) const;
  void Hit(BugState& state, const BugInput& input, double contact_bearing) const;
  void Leave(BugState& state, const BugInput& input) const;

  BugConfiguration configuration_;
};

}  // namespace runnel

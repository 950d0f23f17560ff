#pragma once

#include <optional>

#include "modules/planning/algorithm/bug_components.h"
#include "modules/planning/algorithm/bug_state.h"
#include "modules/planning/algorithm/bug_view.h"

namespace runnel {

struct BugOutput {
  Twist2 twist;
  PlannerStatus status;
};

/// The generic Bug algorithm of S. Kchir, T. Ziadi, M. Ziane, S. Stinckwich, "A Top-Down Approach to
/// Managing Variability in Robotics Algorithms" (2013): Step is its algorithm 2, and the functions bear
/// the names of its hooks. What differs between variants is not overridden but asked of components, one
/// of each kind. Where the paper asks in each call whether an obstacle is in front (and would forget the
/// boundary as soon as the robot has turned along it), here the mode is state.
///
/// Objects hold a configuration and the components only; what is remembered is in the BugState that
/// the caller owns, so variants can be exchanged between two updates. Everything happens in the
/// plane of the body's centre, with obstacles grown by the safe distance. Update does not allocate
/// and is deterministic.
class BugAlgorithm {
 public:
  /// Precondition: FindMisfit(components) is nothing.
  BugAlgorithm(const BugConfiguration& configuration, const BugComponents& components)
      : configuration_(configuration), components_(components) {}

  /// One step. Standstill while the surroundings are unknown, and after a verdict.
  /// Precondition: FindMisfit(components, input.surroundings) is nothing, once they are known.
  [[nodiscard]] BugOutput Update(BugState& state, const BugInput& input) const;

 private:
  // Algorithm 2.
  Twist2 Step(BugState& state, const BugInput& input) const;
  Twist2 MotionToGoal(BugState& state, const BugInput& input) const;
  [[nodiscard]] std::optional<Twist2> LookAt(const BugState& state, const BugInput& input, double bearing) const;
  Twist2 GoAhead(const BugState& state, const BugInput& input, double bearing) const;
  Twist2 GoRoundObstacle(BugState& state, const BugInput& input) const;
  Twist2 IdentifyLeavePoint(BugState& state, const BugInput& input) const;
  void FindLeavePoint(BugState& state, const BugInput& input) const;
  [[nodiscard]] bool LeavePointFound(const BugState& state) const;
  [[nodiscard]] bool ResearchComplete(const BugState& state, const BugInput& input) const;
  [[nodiscard]] bool CompleteCycleAroundObstacle(const BugState& state) const;
  [[nodiscard]] bool HasComeNearer(const BugState& state) const;
  [[nodiscard]] bool GoalReached(const BugState& state) const;
  Twist2 WallFollowing(BugState& state, const BugInput& input) const;
  Twist2 GoToLeavePoint(BugState& state, const BugInput& input) const;
  Twist2 FaceGoal(BugState& state, const BugInput& input) const;

  // What it has no place for.
  Twist2 LookFirst(BugState& state, const BugInput& input) const;
  [[nodiscard]] bool IsStuck(const BugState& state, const BugInput& input) const;
  void Begin(BugState& state, const BugInput& input) const;
  void TakeOver(BugState& state, const BugInput& input) const;
  void Record(BugState& state, const BugInput& input) const;
  void RecordMLine(BugState& state, const BugInput& input) const;
  void RecordIdleTime(BugState& state, const BugInput& input) const;
  void Hit(BugState& state, const BugInput& input, double contact_bearing) const;
  void RestartLap(BugState& state, const BugInput& input) const;
  void Reverse(BugState& state, const BugInput& input) const;
  Twist2 FinishFruitlessLap(BugState& state, const BugInput& input) const;
  Twist2 LeaveWhereNearest(BugState& state, const BugInput& input) const;
  void SetOut(BugState& state, const BugInput& input) const;
  void ChooseShorterWay(BugState& state, const BugInput& input) const;
  std::optional<Twist2> GoAlongBoundary(BugState& state, const BugInput& input) const;
  Twist2 EndPassage(BugState& state, const BugInput& input) const;
  [[nodiscard]] std::optional<Twist2> DriveToPoint(const BugState& state, const BugInput& input, Point2 point) const;
  void Leave(BugState& state, const BugInput& input) const;
  void RefuseLeavePoint(BugState& state, const BugInput& input) const;
  void StartFollowing(BugState& state, const BugInput& input, BoundaryDirection direction,
                      std::optional<double> contact) const;
  void GoOtherWayOrGiveUp(BugState& state, const BugInput& input, Unreachability reason) const;
  void GiveUp(BugState& state, Unreachability reason) const;
  [[nodiscard]] BugView View(const BugState& state, const BugInput& input) const {
    return {configuration_, state, input};
  }

  BugConfiguration configuration_;
  BugComponents components_;
};

}  // namespace runnel

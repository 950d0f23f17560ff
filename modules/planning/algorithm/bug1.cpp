#include "modules/planning/algorithm/bug1.h"

#include <algorithm>
#include <cmath>

namespace runnel {

namespace {

// A second pass comes this near to a point of the first one.
constexpr double kPassDistance = 0.20;  // m
// Near in space is not enough where the boundary comes close to itself: the way gone must fit too.
constexpr double kWayTolerance = 0.40;         // m
constexpr double kWayToleranceByLength = 0.1;  // of the way

bool IsNearAlongTheBoundary(const BugState& state) {
  const double gone = state.status.path_length - state.set_out_length;
  const double tolerance = kWayTolerance + kWayToleranceByLength * state.way_to_leave_point;
  return std::abs(gone - state.way_to_leave_point) < tolerance;
}

bool HasMissedIt(const BugState& state) {
  const double gone = state.status.path_length - state.set_out_length;
  return gone > 2.0 * (state.way_to_leave_point + kWayTolerance);
}

}  // namespace

void Bug1::FindLeavePoint(BugState& state, const BugInput& input) const {
  if (CompleteCycleAroundObstacle(state)) SetOut(state, input);
}

bool Bug1::ResearchComplete(const BugState& state) const {
  return CompleteCycleAroundObstacle(state);
}

void Bug1::SetOut(BugState& state, const BugInput& input) const {
  const double perimeter = state.lap.length() - state.lap.gate_length();
  double ahead = state.closest_length - state.lap.gate_length();
  if (ahead < 0.0) ahead += perimeter;
  // Each leave point is nearer to the goal than the one before, or the robot goes in circles.
  if (state.status.leaves > 0 &&
      state.closest_distance > Distance(state.status.leave_point, input.goal) - kLeavePrecision) {
    GiveUp(state, Unreachability::kNoProgress);
    return;
  }
  state.leave_point = state.closest_point;
  state.way_to_leave_point = std::min(ahead, perimeter - ahead);
  if (perimeter - ahead < ahead) {
    StartFollowing(state, input, Opposite(state.follower.direction()));
  }
}

std::optional<Twist2> Bug1::GoToLeavePoint(BugState& state, const BugInput& input) const {
  const Point2 gap = *state.leave_point - Position(input.pose);
  const bool is_behind = Dot(gap, UnitVector(input.pose.heading)) <= 0.0;
  const bool is_near = Norm(gap) < kLeavePrecision || (is_behind && Norm(gap) < kPassDistance);
  if (is_near && !state.follower.is_turning() && IsNearAlongTheBoundary(state)) {
    state.is_on_last_stretch = true;
  }
  if (state.is_on_last_stretch) return DriveToPoint(input, *state.leave_point, kLeavePrecision);
  if (HasMissedIt(state)) {
    state.status.mode = PlannerMode::kFollowingBoundary;
    RestartLap(state, input);
  }
  return WallFollowing(state, input);
}

void Bug1::RefuseLeavePoint(BugState& state, const BugInput&) const {
  GiveUp(state, Unreachability::kEnclosed);
}

}  // namespace runnel

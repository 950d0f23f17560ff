// How the generic algorithm turns round, gets to leave points, and away from there.

#include <algorithm>
#include <cmath>

#include "modules/planning/algorithm/bug_algorithm.h"

namespace runnel {

namespace {

// m; a robot nearer than this to its leave point is there.
constexpr double kLeavePrecision = 0.05;
// A second pass comes this near to a point of the first one.
constexpr double kPassDistance = 0.20;  // m
// Near in space is not enough where the boundary comes close to itself: the way gone must fit too.
constexpr double kWayTolerance = 0.40;         // m
constexpr double kWayToleranceByLength = 0.1;  // of the way

double ToleranceOf(double way) { return kWayTolerance + kWayToleranceByLength * way; }

double WayGone(const BugState& state) { return state.status.path_length - state.set_out_at; }

bool IsNearAlongTheBoundary(const BugState& state) {
  const double way = state.way_to_leave_point;
  return std::abs(WayGone(state) - way) < ToleranceOf(way);
}

bool HasMissedIt(const BugState& state) {
  return WayGone(state) > 2.0 * (state.way_to_leave_point + kWayTolerance);
}

}  // namespace

// Back along what is known, past the hit point, and on: when the robot is here again, it has seen all
// of the boundary.
void BugAlgorithm::Reverse(BugState& state, const BugInput& input) const {
  state.has_reversed = true;
  state.followed_distance = BugState::kNever;  // the least distance visited stays
  RestartLap(state, input);
  StartFollowing(state, input, Opposite(state.follower.direction()));
}

// The lap proves nothing. It went round something that the hit point is not on: the sensors showed a
// passage closed, then open, and the hit point means nothing here. Or the leave condition is one that may
// miss passages. What can always be done is what Bug1 does; the variant begins anew from there.
Twist2 BugAlgorithm::LeaveWhereNearest(BugState& state, const BugInput& input) const {
  state.leave_point = state.closest_point;
  state.approach = Approach::kAlongBoundary;
  state.last_leave_distance = BugState::kNever;
  state.line_start = state.closest_point;
  state.least_distance_on_line = state.closest_distance;
  state.least_distance_of_all = state.closest_distance;
  SetOut(state, input);
  return GoToLeavePoint(state, input);
}

void BugAlgorithm::SetOut(BugState& state, const BugInput& input) const {
  state.status.mode = PlannerMode::kGoingToLeavePoint;
  state.set_out_at = state.status.path_length;
  state.set_out_point = Position(input.pose);
  state.is_on_last_stretch = false;
  state.is_last_chance = state.approach == Approach::kAlongBoundary;
  if (state.approach == Approach::kAlongBoundary) ChooseShorterWay(state, input);
}

void BugAlgorithm::ChooseShorterWay(BugState& state, const BugInput& input) const {
  const double perimeter = state.lap.length() - state.lap.gate_length();
  double ahead = state.closest_length - state.lap.gate_length();
  if (ahead < 0.0) ahead += perimeter;
  // Each leave point is nearer to the goal than the one before, or the robot goes in circles.
  if (state.closest_distance > state.last_leave_distance - kLeavePrecision) {
    GiveUp(state, Unreachability::kNoProgress);
    return;
  }
  state.way_to_leave_point = std::min(ahead, perimeter - ahead);
  if (perimeter - ahead < ahead) {
    StartFollowing(state, input, Opposite(state.follower.direction()));
  }
}

Twist2 BugAlgorithm::GoToLeavePoint(BugState& state, const BugInput& input) const {
  const auto twist = state.approach == Approach::kAlongBoundary
                         ? GoAlongBoundary(state, input)
                         : DriveToPoint(input, *state.leave_point);
  if (twist) return *twist;
  if (state.approach == Approach::kAcross) return EndPassage(state, input);
  state.status.mode = PlannerMode::kFacingGoal;
  return FaceGoal(state, input);
}

std::optional<Twist2> BugAlgorithm::GoAlongBoundary(BugState& state, const BugInput& input) const {
  const Point2 gap = *state.leave_point - Position(input.pose);
  const bool is_behind = Dot(gap, UnitVector(input.pose.heading)) <= 0.0;
  const bool is_near = Norm(gap) < kLeavePrecision || (is_behind && Norm(gap) < kPassDistance);
  if (is_near && !state.follower.is_turning() && IsNearAlongTheBoundary(state)) {
    state.is_on_last_stretch = true;
  }
  if (state.is_on_last_stretch) return DriveToPoint(input, *state.leave_point);
  if (HasMissedIt(state)) {
    state.status.mode = PlannerMode::kFollowingBoundary;
    RestartLap(state, input);
  }
  return WallFollowing(state, input);
}

// At the point away from the boundary; or before something that was not seen from there.
Twist2 BugAlgorithm::EndPassage(BugState& state, const BugInput& input) const {
  const double wanted = Distance(*state.leave_point, input.goal) + 2 * kLeavePrecision;
  if (state.status.distance_to_goal < wanted) {
    Leave(state, input);
  } else {
    RefuseLeavePoint(state, input);
  }
  return {};
}

std::optional<Twist2> BugAlgorithm::DriveToPoint(const BugInput& input, Point2 point) const {
  const double distance = Distance(Position(input.pose), point);
  if (distance < kLeavePrecision) return std::nullopt;
  const double bearing = BearingTo(input, point);
  const double radius = TravelRadius(configuration_.driving, input.surroundings);
  if (FreeRange(input.surroundings, bearing, radius) < distance) return std::nullopt;
  // What rangers of narrow view have not looked at may be anything.
  if (input.surroundings.is_vague && distance > configuration_.leave_range &&
      std::abs(bearing) > FacedHeadings::kFaced) {
    return TurnTowards(configuration_.driving, bearing);
  }
  const double speed = SpeedToStopWithin(configuration_.driving, distance);
  return DriveTowards(configuration_.driving, input.surroundings, bearing,
                      std::min(speed, configuration_.driving.following_speed));
}

void BugAlgorithm::Leave(BugState& state, const BugInput& input) const {
  const bool is_across = state.approach == Approach::kAcross;
  ++state.status.leaves;
  state.status.leave_point = is_across ? state.set_out_point : Position(input.pose);
  state.leaves.Add(state.status.leave_point);
  state.status.mode = PlannerMode::kMotionToGoal;
  state.last_leave_distance = is_across ? BugState::kNever : state.status.distance_to_goal;
  state.leave_point.reset();
  state.node_side.reset();
}

void BugAlgorithm::RefuseLeavePoint(BugState& state, const BugInput& input) const {
  if (state.is_last_chance) {
    GiveUp(state, Unreachability::kEnclosed);
    return;
  }
  state.status.mode = PlannerMode::kFollowingBoundary;
  state.leave_point.reset();
  state.crossing.reset();
  state.refused_at = state.status.path_length;
  StartFollowing(state, input, state.follower.direction());
}

}  // namespace runnel

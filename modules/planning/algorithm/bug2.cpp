#include "modules/planning/algorithm/bug2.h"

#include "modules/planning/algorithm/m_line.h"

namespace runnel {

namespace {

constexpr double kCrossingReach = 0.15;  // m past a crossing within which it may still leave there
constexpr double kLineLookahead = 0.40;  // m

}  // namespace

void Bug2::FindLeavePoint(BugState& state, const BugInput& input) const {
  const Point2 position = Position(input.pose);
  const auto crossing =
      MLine(input.start, input.goal).Crossing(Position(state.last_pose), position);
  if (crossing &&
      Distance(*crossing, input.goal) < state.hit_distance - configuration().leave_margin) {
    state.crossing = crossing;
  }
  if (!state.crossing) return;
  if (Distance(*state.crossing, position) > kCrossingReach) {
    state.crossing.reset();
  } else if (FreeTowardsGoal(input)) {
    state.leave_point = state.crossing;
  }
}

std::optional<Twist2> Bug2::GoToLeavePoint(BugState& state, const BugInput& input) const {
  return DriveToPoint(input, *state.leave_point, kLeavePrecision);
}

void Bug2::RefuseLeavePoint(BugState& state, const BugInput& input) const {
  state.status.mode = PlannerMode::kFollowingBoundary;
  state.leave_point.reset();
  state.crossing.reset();
  StartFollowing(state, input, state.follower.direction());
}

Point2 Bug2::MotionTarget(const BugInput& input) const {
  return MLine(input.start, input.goal).PointAhead(Position(input.pose), kLineLookahead);
}

}  // namespace runnel

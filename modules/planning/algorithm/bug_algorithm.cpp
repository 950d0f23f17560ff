// The generic algorithm: what every variant does. What it keeps account of, and how it gets to leave
// points, is in bug_leaving.cpp.

#include "modules/planning/algorithm/bug_algorithm.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace runnel {

namespace {

constexpr double kSeen = DegreesToRadians(13.0);          // rad off ahead, within the narrowest view
constexpr double kUnseenNear = 0.05;                      // m of the way to what is unseen, at which it looks
constexpr int kSecondLooks = 3;                           // in a task, so that it ends whatever the sensors say
constexpr double kLookingTime = 4.0;                      // s, of standing and looking before a vague obstacle
constexpr double kTurnsForLookingRound = 2.5;             // that a robot needs where there is no way on
constexpr double kSameBoundary = DegreesToRadians(60.0);  // rad to either side of where it was
constexpr double kHitPlace = Lap::kGateDistance + Lap::kGateHalfWidth;
constexpr double kFalseLeave = 0.05;    // m nearer to the goal, at which a hit is a new one
constexpr double kRefusalReach = 0.15;  // m, of the way on from a leave point that was blocked

bool IsFinal(PlannerMode mode) { return mode == PlannerMode::kReached || mode == PlannerMode::kUnreachable; }

}  // namespace

BugOutput BugAlgorithm::Update(BugState& state, const BugInput& input) const {
  if (!state.has_task || state.start != input.start || state.goal != input.goal) {
    Begin(state, input);
  }
  if (state.composition != components_.Fingerprint()) TakeOver(state, input);
  Record(state, input);
  Twist2 twist;
  if (input.surroundings.is_measured && !IsFinal(state.status.mode)) twist = LookFirst(state, input);
  if (IsFinal(state.status.mode)) twist = {};
  state.last_pose = input.pose;
  state.earlier_turn = std::exchange(state.last_twist, twist).turn;
  return {twist, state.status};
}

// Unseen is not free: where the body would get to what no sensor has looked at, it stops, faces that, turns back, and goes
// on. What was faced from here is known as well as it can be.
Twist2 BugAlgorithm::LookFirst(BugState& state, const BugInput& input) const {
  for (std::optional<double>* heading : {&state.look, &state.look_back}) {
    if (!*heading) continue;
    const double bearing = WrapAngle(**heading - input.pose.heading);
    const bool is_there = std::abs(bearing) < FacedHeadings::kFaced;
    if (!is_there && !IsStuck(state, input)) return TurnTowards(configuration_.driving, bearing);
    heading->reset();
  }
  Twist2 twist = Step(state, input);
  const BoundaryPoint unseen = Unseen(input.surroundings);
  if (twist.forward <= 0.0 || state.faced.Contains(unseen.bearing)) return twist;
  if (unseen.distance > kUnseenNear) {
    twist.forward = std::min(twist.forward, SpeedToStopWithin(configuration_.driving, unseen.distance));
    return twist;
  }
  state.look = input.pose.heading + unseen.bearing;
  state.look_back = input.pose.heading;
  return TurnTowards(configuration_.driving, unseen.bearing);
}

Twist2 BugAlgorithm::Step(BugState& state, const BugInput& input) const {
  if (GoalReached(state)) {
    state.status.mode = PlannerMode::kReached;
    return {};
  }
  switch (state.status.mode) {
    case PlannerMode::kFollowingBoundary:
      return GoRoundObstacle(state, input);
    case PlannerMode::kGoingToLeavePoint:
      return GoToLeavePoint(state, input);
    case PlannerMode::kFacingGoal:
      return FaceGoal(state, input);
    case PlannerMode::kMotionToGoal:
      return MotionToGoal(state, input);
    case PlannerMode::kReached:
    case PlannerMode::kUnreachable:
      break;
  }
  return {};
}

Twist2 BugAlgorithm::GoRoundObstacle(BugState& state, const BugInput& input) const {
  if (IsStuck(state, input)) {
    GiveUp(state, Unreachability::kNoRoom);
    return {};
  }
  const Twist2 along = IdentifyLeavePoint(state, input);
  if (LeavePointFound(state) && ResearchComplete(state, input)) {
    SetOut(state, input);
    return state.status.mode == PlannerMode::kGoingToLeavePoint ? GoToLeavePoint(state, input) : Twist2{};
  }
  if (CompleteCycleAroundObstacle(state) && !LeavePointFound(state)) {
    return FinishFruitlessLap(state, input);
  }
  if (state.lap.is_circling()) {
    RestartLap(state, input);
    state.is_other_loop = true;
  }
  return along;
}

Twist2 BugAlgorithm::IdentifyLeavePoint(BugState& state, const BugInput& input) const {
  const bool may_reverse = !state.has_reversed && !state.follower.is_turning();
  if (may_reverse && components_.revisit->ShallReverse(View(state, input))) Reverse(state, input);
  FindLeavePoint(state, input);
  return WallFollowing(state, input);
}

void BugAlgorithm::FindLeavePoint(BugState& state, const BugInput& input) const {
  state.leave_point.reset();
  state.followed_distance = components_.leave->FollowedDistance(View(state, input));
  if (state.status.path_length < state.refused_at + kRefusalReach) return;
  const auto found = components_.leave->Find(View(state, input));
  if (!found) return;
  state.leave_point = found->point;
  state.approach = found->approach;
}

bool BugAlgorithm::IsStuck(const BugState& state, const BugInput& input) const {
  const double turning = kTurnsForLookingRound * 2 * kPi / configuration_.driving.turn_limit;
  // Where rangers of narrow view have to be turned to what they look at, it takes as long again.
  const double parts = input.surroundings.is_vague ? 2.0 : 1.0;
  return state.idle_time > parts * std::max(configuration_.idle_limit, turning);
}

bool BugAlgorithm::LeavePointFound(const BugState& state) const { return state.leave_point.has_value(); }

bool BugAlgorithm::ResearchComplete(const BugState& state, const BugInput& input) const {
  return components_.leave->ResearchComplete(View(state, input));
}

bool BugAlgorithm::CompleteCycleAroundObstacle(const BugState& state) const {
  return state.lap.is_complete() && components_.leave->decides_after_lap();
}

// Nearer to the goal on this lap than at the hit point; and at the hit point nearer than at the last one
// doubted, so that there is an end.
bool BugAlgorithm::HasComeNearer(const BugState& state) const {
  return state.closest_distance < state.hit_distance - configuration_.leave_margin &&
         state.hit_distance < state.doubted_hit_distance - kFalseLeave;
}

bool BugAlgorithm::GoalReached(const BugState& state) const {
  return state.status.distance_to_goal < configuration_.goal_tolerance;
}

Twist2 BugAlgorithm::MotionToGoal(BugState& state, const BugInput& input) const {
  const Waypoint waypoint = components_.motion->Target(View(state, input));
  if (waypoint.node_side) state.node_side = waypoint.node_side;
  const double bearing = BearingTo(input, waypoint.point);
  const WayAhead way = LookAlong(input.surroundings, bearing, TravelRadius(configuration_.driving, input.surroundings));
  if (way.free_range < std::min(configuration_.hit_range, state.status.distance_to_goal)) {
    if (const auto look = LookAt(state, input, way.obstacle_bearing)) return *look;
    Hit(state, input, way.obstacle_bearing);
    return {};
  }
  // A way that the sensors show now free, now not, is none.
  if (IsStuck(state, input)) {
    Hit(state, input, NearestBoundary(input.surroundings).bearing);
    return {};
  }
  return GoAhead(state, input, bearing);
}

// Faces what may not be there: looked at, it proves to be there or is gone. Nothing: it has been looked at.
std::optional<Twist2> BugAlgorithm::LookAt(const BugState& state, const BugInput& input, double bearing) const {
  const bool is_known = !input.surroundings.is_vague || state.faced.Contains(bearing);
  if (is_known || state.idle_time >= kLookingTime) return std::nullopt;
  return TurnTowards(configuration_.driving, bearing);
}

Twist2 BugAlgorithm::GoAhead(const BugState& state, const BugInput& input, double bearing) const {
  const DrivingConfiguration& driving = configuration_.driving;
  // On a curve the body would go where rangers of narrow view have not looked.
  if (input.surroundings.is_vague && std::abs(bearing) > kSeen) {
    return TurnTowards(driving, bearing);
  }
  const double speed = std::min(driving.cruise_speed, SpeedToStopWithin(driving, state.status.distance_to_goal));
  return DriveTowards(driving, input.surroundings, bearing, speed);
}

void BugAlgorithm::Hit(BugState& state, const BugInput& input, double contact_bearing) const {
  state.status.mode = PlannerMode::kFollowingBoundary;
  state.progress_point = Position(input.pose);
  state.idle_time = 0.0;
  const double distance = state.status.distance_to_goal;
  // Back at the wall just left, without having come nearer to the goal: it was no leave point.
  if (distance > state.last_leave_distance - kFalseLeave) {
    if (!state.leaves.empty()) {
      state.leaves.RemoveLast();
      --state.status.leaves;
      if (!state.leaves.empty()) state.status.leave_point = state.leaves.back();
    }
    state.last_leave_distance = BugState::kNever;
    RefuseLeavePoint(state, input);
    return;
  }
  ++state.status.hits;
  state.status.hit_point = Position(input.pose);
  state.hits.Add(state.status.hit_point);
  state.hit_distance = distance;
  state.least_distance = distance;
  state.followed_distance = BugState::kNever;
  state.has_reversed = false;
  state.has_doubted = false;
  state.is_last_chance = false;
  state.is_off_boundary = false;
  RestartLap(state, input);
  const BoundaryDirection direction = components_.direction->Choose(View(state, input), contact_bearing);
  state.last_direction = direction;
  state.node_side.reset();
  state.follower.Start(direction, input.pose, contact_bearing);
}

Twist2 BugAlgorithm::FinishFruitlessLap(BugState& state, const BugInput& input) const {
  // What was hit may have been none, a vague echo say: then the way is free where it was not.
  const bool is_at_hit_point = Distance(Position(input.pose), state.status.hit_point) < kHitPlace;
  if (state.is_other_loop && state.second_looks < kSecondLooks) {
    ++state.second_looks;
    return LeaveWhereNearest(state, input);
  }
  if (components_.leave->MayMissPassages(View(state, input)) && HasComeNearer(state)) {
    state.doubted_hit_distance = state.hit_distance;
    return LeaveWhereNearest(state, input);
  }
  if (!is_at_hit_point || state.second_looks == kSecondLooks || !IsFreeTowardsGoal(View(state, input))) {
    GoOtherWayOrGiveUp(state, input, Unreachability::kEnclosed);
    return {};
  }
  ++state.second_looks;
  state.is_last_chance = true;
  state.approach = Approach::kNear;
  state.status.mode = PlannerMode::kFacingGoal;
  return FaceGoal(state, input);
}

Twist2 BugAlgorithm::FaceGoal(BugState& state, const BugInput& input) const {
  const double bearing = BearingTo(input, input.goal);
  if (std::abs(bearing) > FacedHeadings::kFaced) {
    return TurnTowards(configuration_.driving, bearing);
  }
  const bool may_leave =
      state.is_last_chance ? IsFreeTowardsGoal(View(state, input)) : components_.leave->MayLeave(View(state, input));
  if (may_leave) {
    Leave(state, input);
  } else {
    RefuseLeavePoint(state, input);
  }
  return {};
}

Twist2 BugAlgorithm::WallFollowing(BugState& state, const BugInput& input) const {
  return state.follower.Update(configuration_.driving, input.pose, input.surroundings, state.faced);
}

// The boundary at `contact` (rad, world), if there is one still: in a passage the other side may be nearer.
void BugAlgorithm::StartFollowing(BugState& state, const BugInput& input, BoundaryDirection direction,
                                  std::optional<double> contact) const {
  BoundaryPoint nearest;
  if (contact) nearest = NearestBoundary(input.surroundings, *contact - input.pose.heading, kSameBoundary);
  if (!std::isfinite(nearest.distance)) nearest = NearestBoundary(input.surroundings);
  state.follower.Start(direction, input.pose, nearest.bearing);
}

// The arcs of far echoes may have closed a passage; from the other side they lie elsewhere. So with rangers of narrow view
// nothing is out of reach before the robot has gone round the other way, too.
void BugAlgorithm::GoOtherWayOrGiveUp(BugState& state, const BugInput& input, Unreachability reason) const {
  if (!input.surroundings.is_vague || state.has_doubted) return GiveUp(state, reason);
  state.has_doubted = true;
  state.is_last_chance = false;
  state.status.mode = PlannerMode::kFollowingBoundary;
  Reverse(state, input);
}

void BugAlgorithm::GiveUp(BugState& state, Unreachability reason) const {
  state.status.mode = PlannerMode::kUnreachable;
  state.status.unreachability = reason;
}

}  // namespace runnel

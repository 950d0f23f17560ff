// How the generic algorithm turns round, gets to leave points, and away from there.

#include <algorithm>
#include <cmath>

#include "modules/planning/algorithm/bug_algorithm.h"
#include "modules/planning/algorithm/m_line.h"

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

constexpr double kProgress = 0.10;       // m that count as having got on
constexpr double kMoving = 0.2;          // m or rad, commanded,
constexpr double kMovingTime = 1.5;      // s; at less than full speed that is so much of it
constexpr double kRecent = 3.0;          // s, or so, lately
constexpr double kResponse = 0.08;       // of the turns commanded; a robot that does less does not follow
constexpr double kStill = 0.04;          // m or rad; poses are not as exact as to tell less from standstill
constexpr double kCrossingReach = 0.15;  // m past a crossing within which it may still leave there
constexpr double kLineTolerance = 0.08;  // m; a robot that comes so near to the line is on it
constexpr double kParallel = 0.001;      // m in a step by which it comes nearer at least, else it passes

// Commanded to move, and not moving. A robot that turns to and fro, and comes to nothing, does what it is told. What it
// turns is looked at an update later: at once, the noise of a pose would be in the command and in what seems to follow.
bool IsHeld(const BugState& state, const DrivingConfiguration& driving) {
  const double speed = std::min(driving.cruise_speed, driving.following_speed);
  return state.commanded.forward > std::min(kMoving, kMovingTime * speed) ||
         (std::abs(state.commanded.turn) > std::min(kMoving, kMovingTime * driving.turn_limit) &&
          state.response < kResponse * state.turning);
}

}  // namespace

// Back along what is known, past the hit point, and on: when the robot is here again, it has seen all
// of the boundary.
void BugAlgorithm::Reverse(BugState& state, const BugInput& input) const {
  state.has_reversed = true;
  state.followed_distance = BugState::kNever;  // the least distance visited stays
  RestartLap(state, input);
  StartFollowing(state, input, Opposite(state.follower.direction()),
                 state.follower.ContactHeading(input.pose, input.surroundings));
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
  return state.status.mode == PlannerMode::kGoingToLeavePoint ? GoToLeavePoint(state, input) : Twist2{};
}

void BugAlgorithm::SetOut(BugState& state, const BugInput& input) const {
  state.status.mode = PlannerMode::kGoingToLeavePoint;
  state.set_out_at = state.status.path_length;
  state.set_out_point = Position(input.pose);
  state.set_out_contact = state.follower.ContactHeading(input.pose, input.surroundings);
  state.is_off_boundary = state.approach != Approach::kAlongBoundary;
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
    GoOtherWayOrGiveUp(state, input, Unreachability::kNoProgress);
    return;
  }
  state.way_to_leave_point = std::min(ahead, perimeter - ahead);
  if (perimeter - ahead < ahead) {
    StartFollowing(state, input, Opposite(state.follower.direction()), state.set_out_contact);
  }
}

Twist2 BugAlgorithm::GoToLeavePoint(BugState& state, const BugInput& input) const {
  const auto twist = state.approach == Approach::kAlongBoundary ? GoAlongBoundary(state, input)
                                                                : DriveToPoint(state, input, *state.leave_point);
  if (twist) return *twist;
  if (state.approach == Approach::kAcross) return EndPassage(state, input);
  if (state.approach == Approach::kBack) {
    RefuseLeavePoint(state, input);
    return {};
  }
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
  if (state.is_on_last_stretch) return DriveToPoint(state, input, *state.leave_point);
  if (IsStuck(state, input)) {
    GiveUp(state, Unreachability::kNoRoom);
    return Twist2{};
  }
  const bool has_missed_it = WayGone(state) > 2.0 * (state.way_to_leave_point + kWayTolerance);
  if (has_missed_it) {
    state.status.mode = PlannerMode::kFollowingBoundary;
    RestartLap(state, input);
  }
  return WallFollowing(state, input);
}

// At the point away from the boundary; or before something that was not seen from there. Then what is followed is still the
// boundary of before, not what is nearest here.
Twist2 BugAlgorithm::EndPassage(BugState& state, const BugInput& input) const {
  const double wanted = Distance(*state.leave_point, input.goal) + 2 * kLeavePrecision;
  if (state.status.distance_to_goal < wanted) {
    Leave(state, input);
    return {};
  }
  state.approach = Approach::kBack;
  state.leave_point = state.set_out_point;
  return GoToLeavePoint(state, input);
}

std::optional<Twist2> BugAlgorithm::DriveToPoint(const BugState& state, const BugInput& input, Point2 point) const {
  const double distance = Distance(Position(input.pose), point);
  if (distance < kLeavePrecision || IsStuck(state, input)) return std::nullopt;
  const double bearing = BearingTo(input, point);
  const WayAhead way = LookAlong(input.surroundings, bearing, TravelRadius(configuration_.driving, input.surroundings));
  if (way.free_range < distance) return LookAt(state, input, way.obstacle_bearing);
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
    GoOtherWayOrGiveUp(state, input, Unreachability::kEnclosed);
    return;
  }
  state.status.mode = PlannerMode::kFollowingBoundary;
  state.leave_point.reset();
  state.crossing.reset();
  state.refused_at = state.status.path_length;
  const bool is_where_it_set_out = Distance(Position(input.pose), state.set_out_point) < kPassDistance;
  StartFollowing(state, input, state.follower.direction(), is_where_it_set_out ? state.set_out_contact : std::nullopt);
}

// What the generic algorithm keeps account of, whatever variant it is.

void BugAlgorithm::Begin(BugState& state, const BugInput& input) const {
  state = BugState{};
  state.has_task = true;
  state.start = input.start;
  state.goal = input.goal;
  state.composition = components_.Fingerprint();
  state.line_start = input.start;
  state.last_pose = state.still_pose = input.pose;
  state.progress_point = Position(input.pose);
  state.faced.Start(input.pose);
}

// The variant before may have been to places that this one would not have left, or off this one's
// line. What is known of the task is kept; what this variant compares with begins at the last hit
// point, or here: as if it had hit the obstacle itself, and a whole lap is made from here.
void BugAlgorithm::TakeOver(BugState& state, const BugInput& input) const {
  state.composition = components_.Fingerprint();
  const bool is_at_obstacle = state.status.mode != PlannerMode::kMotionToGoal;
  const Point2 from = is_at_obstacle ? state.status.hit_point : Position(input.pose);
  const double distance = Distance(from, input.goal);
  state.line_start = from;
  state.least_distance_on_line = distance;
  state.least_distance_of_all = distance;
  state.last_leave_distance = BugState::kNever;
  state.crossing.reset();
  if (!is_at_obstacle) return;
  state.status.distance_to_goal = Distance(Position(input.pose), input.goal);
  state.least_distance = state.status.distance_to_goal;
  state.followed_distance = BugState::kNever;
  state.has_reversed = false;
  state.has_doubted = false;
  state.refused_at = -BugState::kNever;
  const auto leave_point = state.leave_point;
  RestartLap(state, input);
  // On its way there it goes on, but if it is none, this lap is the one to go by.
  if (state.status.mode != PlannerMode::kFollowingBoundary) state.leave_point = leave_point;
}

void BugAlgorithm::Record(BugState& state, const BugInput& input) const {
  const Point2 position = Position(input.pose);
  PlannerStatus& status = state.status;
  status.path_length += Distance(Position(state.last_pose), position);
  status.distance_to_goal = Distance(position, input.goal);
  state.faced.Update(input.pose);
  RecordIdleTime(state, input);
  RecordMLine(state, input);
  state.least_distance_of_all = std::min(state.least_distance_of_all, status.distance_to_goal);
  if (status.hits == 0) return;
  state.least_distance = std::min(state.least_distance, status.distance_to_goal);
  const bool has_turned_back = status.mode == PlannerMode::kFollowingBoundary && !state.follower.is_turning();
  state.is_off_boundary = state.is_off_boundary && !has_turned_back;
  if (state.is_off_boundary) return;  // whatever it turns there would make the lap one turn too short or too long
  state.lap.Update(input.pose);
  if (status.distance_to_goal < state.closest_distance) {
    state.closest_distance = status.distance_to_goal;
    state.closest_point = position;
    state.closest_length = state.lap.length();
  }
}

void BugAlgorithm::RecordIdleTime(BugState& state, const BugInput& input) const {
  const double kept = std::max(0.0, 1.0 - input.time_step / kRecent);
  state.commanded.forward = kept * state.commanded.forward + state.last_twist.forward * input.time_step;
  state.commanded.turn = kept * state.commanded.turn + state.last_twist.turn * input.time_step;
  state.turning = kept * state.turning + state.earlier_turn * state.earlier_turn * input.time_step;
  state.response = kept * state.response + state.earlier_turn * WrapAngle(input.pose.heading - state.last_pose.heading);
  const double moved = Distance(Position(state.still_pose), Position(input.pose));
  if (moved > kStill || std::abs(WrapAngle(input.pose.heading - state.still_pose.heading)) > kStill) {
    state.still_pose = input.pose;
    state.commanded = {};
    state.turning = state.response = 0.0;
  }
  // Neither blind nor held by somebody else is without room.
  if (input.surroundings.is_measured && !IsHeld(state, configuration_.driving)) state.idle_time += input.time_step;
  if (Distance(state.progress_point, Position(input.pose)) > kProgress) {
    state.progress_point = Position(input.pose);
    state.idle_time = 0.0;
  }
}

void BugAlgorithm::RecordMLine(BugState& state, const BugInput& input) const {
  const Point2 before = Position(state.last_pose), here = Position(input.pose);
  const MLine line(state.line_start, input.goal);
  auto crossing = line.Crossing(before, here);
  // A body that keeps its distance may pass the line by a few centimetres where its ideal touches it.
  const double gap = line.DistanceTo(here);
  if (!crossing && gap < kLineTolerance && line.DistanceTo(before) - gap < kParallel) {
    crossing = line.Nearest(here);
  }
  const bool has_passed = state.crossing && (crossing || Distance(*state.crossing, here) > kCrossingReach);
  if (has_passed) {
    state.least_distance_on_line = std::min(state.least_distance_on_line, Distance(*state.crossing, input.goal));
    state.crossing.reset();
  }
  if (crossing) state.crossing = crossing;
}

void BugAlgorithm::RestartLap(BugState& state, const BugInput& input) const {
  state.closest_distance = state.status.distance_to_goal;
  state.closest_point = Position(input.pose);
  state.closest_length = 0.0;
  state.leave_point.reset();
  state.is_other_loop = false;
  state.lap.Start(input.pose);
}

}  // namespace runnel

#include "modules/planning/algorithm/bug_algorithm.h"

#include <algorithm>
#include <cmath>

namespace runnel {

namespace {

constexpr double kFaced = DegreesToRadians(8.0);  // rad of bearing at which the robot faces a point
constexpr double kProgress = 0.10;                // m that count as having got on
constexpr double kClearanceNoise = 0.02;          // m, of the distance to a boundary followed
constexpr int kSecondLooks = 3;       // in a task, so that it ends whatever the sensors say
constexpr double kLookingTime = 4.0;  // s, of standing and looking before a vague obstacle
constexpr double kHitPlace = Lap::kGateDistance + Lap::kGateHalfWidth;
constexpr double kFalseLeave = 0.05;  // m nearer to the goal, at which a hit is a new one

double BearingTo(const BugInput& input, Point2 point) {
  return Direction(ToBody(input.pose, point));
}

bool IsFinal(PlannerMode mode) {
  return mode == PlannerMode::kReached || mode == PlannerMode::kUnreachable;
}

}  // namespace

BugOutput BugAlgorithm::Update(BugState& state, const BugInput& input) const {
  if (!state.has_task || state.start != input.start || state.goal != input.goal) {
    Begin(state, input);
  }
  Record(state, input);
  Twist2 twist;
  if (input.surroundings.sensor_range > 0.0F && !IsFinal(state.status.mode)) {
    twist = Step(state, input);
  }
  if (IsFinal(state.status.mode)) twist = {};
  state.last_pose = input.pose;
  return {twist, state.status};
}

Twist2 BugAlgorithm::Step(BugState& state, const BugInput& input) const {
  if (GoalReached(state)) {
    state.status.mode = PlannerMode::kReached;
    return {};
  }
  switch (state.status.mode) {
    case PlannerMode::kMotionToGoal:
      return MotionToGoal(state, input);
    case PlannerMode::kFollowingBoundary:
      return IdentifyLeavePoint(state, input);
    case PlannerMode::kGoingToLeavePoint:
      return MoveToLeavePoint(state, input);
    case PlannerMode::kFacingGoal:
      return FaceGoal(state, input);
    case PlannerMode::kReached:
    case PlannerMode::kUnreachable:
      break;
  }
  return {};
}

void BugAlgorithm::Begin(BugState& state, const BugInput& input) const {
  state = BugState{};
  state.has_task = true;
  state.start = input.start;
  state.goal = input.goal;
  state.last_pose = input.pose;
  state.progress_point = Position(input.pose);
}

void BugAlgorithm::Record(BugState& state, const BugInput& input) const {
  const Point2 position = Position(input.pose);
  state.status.path_length += Distance(Position(state.last_pose), position);
  state.status.distance_to_goal = Distance(position, input.goal);
  if (input.surroundings.sensor_range > 0.0F) state.idle_time += input.time_step;
  if (Distance(state.progress_point, position) > kProgress) {
    state.progress_point = position;
    state.idle_time = 0.0;
  }
  if (state.status.hits == 0) return;
  state.lap.Update(input.pose);
  if (state.status.distance_to_goal < state.closest_distance) {
    state.closest_distance = state.status.distance_to_goal;
    state.closest_point = position;
    state.closest_length = state.lap.length();
  }
}

Twist2 BugAlgorithm::MotionToGoal(BugState& state, const BugInput& input) const {
  const double bearing = BearingTo(input, MotionTarget(input));
  const WayAhead way = LookAlong(input.surroundings, bearing,
                                 TravelRadius(configuration_.driving, input.surroundings));
  if (way.free_range < std::min(configuration_.hit_range, state.status.distance_to_goal)) {
    // Face what may not be there: looked at, it proves to be there or is gone.
    if (input.surroundings.is_vague && std::abs(way.obstacle_bearing) > kFaced &&
        state.idle_time < kLookingTime) {
      return TurnTowards(configuration_.driving, way.obstacle_bearing);
    }
    Hit(state, input, way.obstacle_bearing);
    return {};
  }
  return GoAhead(state, input, bearing);
}

Twist2 BugAlgorithm::GoAhead(const BugState& state, const BugInput& input, double bearing) const {
  const DrivingConfiguration& driving = configuration_.driving;
  const double speed =
      std::min(driving.cruise_speed, SpeedToStopWithin(driving, state.status.distance_to_goal));
  return DriveTowards(driving, input.surroundings, bearing, speed);
}

Twist2 BugAlgorithm::IdentifyLeavePoint(BugState& state, const BugInput& input) const {
  if (state.idle_time > configuration_.idle_limit) {
    GiveUp(state, Unreachability::kNoRoom);
    return {};
  }
  FindLeavePoint(state, input);
  if (IsFinal(state.status.mode)) return {};
  if (LeavePointFound(state) && ResearchComplete(state)) {
    state.status.mode = PlannerMode::kGoingToLeavePoint;
    state.set_out_length = state.status.path_length;
    state.is_on_last_stretch = false;
    return MoveToLeavePoint(state, input);
  }
  if (CompleteCycleAroundObstacle(state) && !LeavePointFound(state)) {
    return FinishFruitlessLap(state, input);
  }
  if (state.lap.is_circling()) RestartLap(state, input);
  return WallFollowing(state, input);
}

Twist2 BugAlgorithm::FinishFruitlessLap(BugState& state, const BugInput& input) const {
  // What was hit may have been none, a vague echo say: then the way is free where it was not.
  const bool is_at_hit_point = Distance(Position(input.pose), state.status.hit_point) < kHitPlace;
  if (!is_at_hit_point || state.second_looks == kSecondLooks || !FreeTowardsGoal(input)) {
    GiveUp(state, Unreachability::kEnclosed);
    return {};
  }
  ++state.second_looks;
  state.status.mode = PlannerMode::kFacingGoal;
  return FaceGoal(state, input);
}

Twist2 BugAlgorithm::MoveToLeavePoint(BugState& state, const BugInput& input) const {
  if (const auto twist = GoToLeavePoint(state, input)) return *twist;
  if (state.status.mode != PlannerMode::kGoingToLeavePoint) return {};
  state.status.mode = PlannerMode::kFacingGoal;
  return FaceGoal(state, input);
}

Twist2 BugAlgorithm::FaceGoal(BugState& state, const BugInput& input) const {
  const double bearing = BearingTo(input, input.goal);
  if (std::abs(bearing) > kFaced) return TurnTowards(configuration_.driving, bearing);
  if (FreeTowardsGoal(input)) {
    Leave(state, input);
  } else {
    RefuseLeavePoint(state, input);
  }
  return {};
}

void BugAlgorithm::Hit(BugState& state, const BugInput& input, double contact_bearing) const {
  const double distance = state.status.distance_to_goal;
  state.status.mode = PlannerMode::kFollowingBoundary;
  state.progress_point = Position(input.pose);
  state.idle_time = 0.0;
  // Back at the wall just left, without having come nearer to the goal: it was no leave point.
  if (state.status.leaves > 0 &&
      distance > Distance(state.status.leave_point, input.goal) - kFalseLeave) {
    RefuseLeavePoint(state, input);
    return;
  }
  ++state.status.hits;
  state.status.hit_point = Position(input.pose);
  state.hits.Add(state.status.hit_point);
  state.hit_distance = distance;
  RestartLap(state, input);
  state.follower.Start(configuration_.first_direction, input.pose, contact_bearing);
}

void BugAlgorithm::RestartLap(BugState& state, const BugInput& input) const {
  state.closest_distance = state.status.distance_to_goal;
  state.closest_point = Position(input.pose);
  state.closest_length = 0.0;
  state.leave_point.reset();
  state.crossing.reset();
  state.lap.Start(input.pose);
}

void BugAlgorithm::Leave(BugState& state, const BugInput& input) const {
  ++state.status.leaves;
  state.status.leave_point = Position(input.pose);
  state.leaves.Add(state.status.leave_point);
  state.status.mode = PlannerMode::kMotionToGoal;
  state.leave_point.reset();
  state.crossing.reset();
}

void BugAlgorithm::GiveUp(BugState& state, Unreachability reason) const {
  state.status.mode = PlannerMode::kUnreachable;
  state.status.unreachability = reason;
}

bool BugAlgorithm::LeavePointFound(const BugState& state) const {
  return state.leave_point.has_value();
}

bool BugAlgorithm::CompleteCycleAroundObstacle(const BugState& state) const {
  return state.lap.is_complete();
}

bool BugAlgorithm::GoalReached(const BugState& state) const {
  return state.status.distance_to_goal < configuration_.goal_tolerance;
}

bool BugAlgorithm::FreeTowardsGoal(const BugInput& input) const {
  // As wide as the clearance at this very place allows: narrower would call a way free that runs
  // into the boundary followed, wider would call the tangent blocked.
  const double safe_distance = double{input.surroundings.safe_distance};
  const double narrowest = TravelRadius(configuration_.driving, input.surroundings);
  const double radius = std::clamp(NearestBoundary(input.surroundings).distance - kClearanceNoise,
                                   narrowest, safe_distance);
  const double distance = Distance(Position(input.pose), input.goal);
  return FreeRange(input.surroundings, BearingTo(input, input.goal), radius) >=
         std::min(configuration_.leave_range, distance);
}

Twist2 BugAlgorithm::WallFollowing(BugState& state, const BugInput& input) const {
  return state.follower.Update(configuration_.driving, input.pose, input.surroundings);
}

void BugAlgorithm::StartFollowing(BugState& state, const BugInput& input,
                                  BoundaryDirection direction) const {
  state.follower.Start(direction, input.pose, NearestBoundary(input.surroundings).bearing);
}

std::optional<Twist2> BugAlgorithm::DriveToPoint(const BugInput& input, Point2 point,
                                                 double tolerance) const {
  const double distance = Distance(Position(input.pose), point);
  if (distance < tolerance) return std::nullopt;
  const double radius = TravelRadius(configuration_.driving, input.surroundings);
  if (FreeRange(input.surroundings, BearingTo(input, point), radius) < distance) {
    return std::nullopt;
  }
  const double speed = SpeedToStopWithin(configuration_.driving, distance);
  return DriveTowards(configuration_.driving, input.surroundings, BearingTo(input, point),
                      std::min(speed, configuration_.driving.following_speed));
}

}  // namespace runnel

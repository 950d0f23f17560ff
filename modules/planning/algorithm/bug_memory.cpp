// What the generic algorithm keeps account of, whatever variant it is.

#include <algorithm>
#include <cmath>

#include "modules/planning/algorithm/bug_algorithm.h"
#include "modules/planning/algorithm/m_line.h"

namespace runnel {

namespace {

constexpr double kProgress = 0.10;       // m that count as having got on
constexpr double kMoving = 0.005;        // m or rad in a step, commanded
constexpr double kStill = 0.0005;        // m or rad in a step
constexpr double kCrossingReach = 0.15;  // m past a crossing within which it may still leave there
constexpr double kLineTolerance = 0.08;  // m; a robot that comes so near to the line is on it
constexpr double kParallel =
    0.001;  // m in a step by which it comes nearer at least, else it passes

// Commanded to move, and not moving at all. With noise in its poses this cannot be seen.
bool IsHeld(const BugState& state, const BugInput& input) {
  const double moved = Distance(Position(state.last_pose), Position(input.pose));
  const double turned = std::abs(WrapAngle(input.pose.heading - state.last_pose.heading));
  const double forward = state.last_twist.forward * input.time_step;
  const double turn = std::abs(state.last_twist.turn) * input.time_step;
  return forward + turn > kMoving && moved < kStill && turned < kStill;
}

}  // namespace

void BugAlgorithm::Begin(BugState& state, const BugInput& input) const {
  state = BugState{};
  state.has_task = true;
  state.start = input.start;
  state.goal = input.goal;
  state.composition = components_.Fingerprint();
  state.line_start = input.start;
  state.last_pose = input.pose;
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
  if (state.status.mode != PlannerMode::kFollowingBoundary) return;
  state.status.distance_to_goal = Distance(Position(input.pose), input.goal);
  state.least_distance = state.status.distance_to_goal;
  state.followed_distance = BugState::kNever;
  state.has_reversed = false;
  state.refused_at = -BugState::kNever;
  RestartLap(state, input);
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
  state.lap.Update(input.pose);
  if (status.distance_to_goal < state.closest_distance) {
    state.closest_distance = status.distance_to_goal;
    state.closest_point = position;
    state.closest_length = state.lap.length();
  }
}

void BugAlgorithm::RecordIdleTime(BugState& state, const BugInput& input) const {
  // Neither blind nor held by somebody else is without room.
  if (input.surroundings.is_measured && !IsHeld(state, input)) state.idle_time += input.time_step;
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
  const bool has_passed =
      state.crossing && (crossing || Distance(*state.crossing, here) > kCrossingReach);
  if (has_passed) {
    state.least_distance_on_line =
        std::min(state.least_distance_on_line, Distance(*state.crossing, input.goal));
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

#include "modules/planning/bug_planner.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "modules/planning/algorithm/bug_state.h"
#include "modules/types/algorithm/drawing.h"
#include "modules/types/algorithm/pose.h"
#include "modules/types/algorithm/surroundings.h"

namespace runnel {

namespace {

// Seen on light and on dark ground.
constexpr DrawnColour kLine{.red = 0.56, .green = 0.42, .blue = 0.86, .alpha = 0.7};
constexpr DrawnColour kBoundary{.red = 0.9, .green = 0.5, .blue = 0.1, .alpha = 0.8};
constexpr DrawnColour kLeaving{.red = 0.15, .green = 0.6, .blue = 0.4, .alpha = 0.9};

std::vector<Point2> BoundaryPoints(const Pose2& pose, const Surroundings& surroundings) {
  std::vector<Point2> points;
  for (int sector = 0; sector < Surroundings::kSectors; ++sector) {
    const double distance = ContourDistance(surroundings, sector);
    if (!std::isfinite(distance)) continue;
    points.push_back(Position(pose) + distance * UnitVector(pose.heading + SectorBearing(sector)));
  }
  return points;
}

/// What a planner of the Bug family has in mind, in the world's frame: the line to the goal, the boundary as it knows
/// it from `pose`, the nearest point of the boundary to the goal, and the way to its leave point. Allocates.
Drawing DrawBugState(const BugState& state, const Pose2& pose, const Surroundings& surroundings) {
  Drawing drawing;
  drawing.AddLine({state.line_start, state.goal}, kLine, 0.025);
  if (auto points = BoundaryPoints(pose, surroundings); !points.empty()) {
    drawing.AddPoints(std::move(points), kBoundary, 0.07);
  }
  if (state.closest_distance < BugState::kNever) {
    drawing.AddPoints({state.closest_point}, kLeaving, 0.14);
  }
  if (state.leave_point) {
    drawing.AddLine({Position(pose), *state.leave_point}, kLeaving, 0.03);
  }
  return drawing;
}

constexpr double kTurnInAPeriod = 0.7;  // of the bearing

// Within what the list has reserved.
void CopyPoints(const PointHistory& history, std::vector<Point2>& list) {
  list.clear();
  for (std::size_t i = 0; i < history.size(); ++i) list.push_back(history[i]);
}

}  // namespace

void BugPlanner::AddStep() {
  step_.emplace(this, "step",
                ParameterOptions<double>{.default_value = kDefaults.step,
                                         .bounds = {0.01, 10.0},
                                         .unit = "m",
                                         .description = "by which free_range_step must see that it gets nearer"});
}

BugConfiguration BugPlanner::Configuration(double time_step) const {
  BugConfiguration configuration;
  configuration.first_direction = first_direction.Get();
  configuration.goal_tolerance = goal_tolerance.Get();
  configuration.leave_margin = leave_margin.Get();
  if (step_) configuration.step = step_->Get();
  configuration.driving.cruise_speed = cruise_speed.Get();
  configuration.driving.following_speed = following_speed.Get();
  configuration.driving.turn_limit = turn_limit.Get();
  // A bearing is turned away in one period at most, or the robot would swing to and fro.
  if (time_step > 0.0) {
    configuration.driving.turn_gain = std::min(configuration.driving.turn_gain, kTurnInAPeriod / time_step);
  }
  return configuration;
}

Result<void> BugPlanner::Prepare() {
  if (const auto misfit = FindMisfit(Components())) {
    return Error{.message = misfit->message, .path = path(), .hint = misfit->hint};
  }
  points.PrepareBuffers([](HitAndLeavePoints& buffer) {
    buffer.hits.reserve(PointHistory::kCapacity);
    buffer.leaves.reserve(PointHistory::kCapacity);
  });
  return {};
}

void BugPlanner::Update() {
  const auto view = surroundings_timeout.Read(surroundings, now());
  const auto here = pose_timeout.Read(pose, view ? view.timestamp() : now());
  const auto there = goal.Read();
  if (surroundings_timeout.lack() == InputLack::kNotMeasured) twist.Publish(Twist2{});
  if (there.is_new() && !IsFinite(*there)) log().Warn("goal is not a number");
  // Going on would be driving blind.
  if (!view.is_new() || !here || !there || !IsFinite(*there)) return;
  CheckSensors(*view);
  const bool is_same_task = state_.has_task && state_.goal == *there;
  // While it was silent, the robot stood.
  const double most = surroundings_timeout.limit.Get();
  const BugInput input{.time_step = last_ ? std::min(ToSeconds(now() - *last_), most) : 0.0,
                       .pose = *here,
                       .surroundings = *view,
                       .start = is_same_task ? state_.start : Position(*here),
                       .goal = *there};
  last_ = now();
  const BugOutput output = BugAlgorithm(Configuration(input.time_step), Components()).Update(state_, input);
  twist.Publish(output.twist);
  status.Publish(output.status);
  PublishPoints();
  if (drawing.is_watched()) drawing.Publish(DrawBugState(state_, *here, *view));
}

void BugPlanner::CheckSensors(const Surroundings& view) {
  if (!view.is_measured) return;
  if (const auto misfit = FindMisfit(Components(), view)) {
    throw ElementError({.message = misfit->message, .path = path(), .hint = misfit->hint});
  }
}

void BugPlanner::PublishPoints() {
  const std::size_t count = state_.hits.total() + state_.leaves.total();
  if (count == published_points_) return;
  auto loan = points.Loan();
  if (!loan) return;
  CopyPoints(state_.hits, loan->hits);
  CopyPoints(state_.leaves, loan->leaves);
  points.Publish(std::move(loan));
  published_points_ = count;
}

}  // namespace runnel

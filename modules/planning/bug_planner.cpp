#include "modules/planning/bug_planner.h"

namespace runnel {

namespace {

// Within what the list has reserved.
void CopyPoints(const PointHistory& history, std::vector<Point2>& list) {
  list.clear();
  for (std::size_t i = 0; i < history.size(); ++i) list.push_back(history[i]);
}

}  // namespace

BugConfiguration BugPlanner::Configuration() const {
  BugConfiguration configuration;
  configuration.first_direction = first_direction.Get();
  configuration.goal_tolerance = goal_tolerance.Get();
  configuration.leave_margin = leave_margin.Get();
  configuration.driving.cruise_speed = cruise_speed.Get();
  configuration.driving.following_speed = following_speed.Get();
  configuration.driving.turn_limit = turn_limit.Get();
  return configuration;
}

Result<void> BugPlanner::Prepare() {
  points.PrepareBuffers([](HitAndLeavePoints& buffer) {
    buffer.hits.reserve(PointHistory::kCapacity);
    buffer.leaves.reserve(PointHistory::kCapacity);
  });
  return {};
}

void BugPlanner::Update() {
  const auto view = surroundings.Read();
  const auto here = pose.Read();
  const auto there = goal.Read();
  if (!view.is_new() || !here || !there) return;
  // Whoever localises has fallen silent: going on would be driving blind.
  if (view.stamp() - here.stamp() > FromSeconds(pose_timeout.Get())) return;
  if (!start_ || !(goal_ == *there)) {
    start_ = Position(*here);
    goal_ = *there;
    last_ = now();
  }
  const BugInput input{.time_step = ToSeconds(now() - last_),
                       .pose = *here,
                       .surroundings = *view,
                       .start = *start_,
                       .goal = goal_};
  last_ = now();
  const BugOutput output = Plan(Configuration(), state_, input);
  twist.Publish(output.twist);
  status.Publish(output.status);
  PublishPoints();
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

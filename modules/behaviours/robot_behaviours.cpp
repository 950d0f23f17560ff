#include "modules/behaviours/robot_behaviours.h"

#include <algorithm>

namespace runnel {

namespace {
constexpr const char* kNoGoal = "goal has never come";
constexpr const char* kUnclearGoal = "goal is not a number";
constexpr double kWhileLooking = 0.25;  // of the time counts as being stuck, so that looks have an end
}  // namespace

std::optional<Behaviour::Outcome> DriveToGoalBehaviour::Behave(double activation) {
  const auto here = pose_timeout.Read(pose, now());
  const auto there = goal.Read();
  if (!here) return Miss(pose_timeout.words());
  if (!there) return Miss(kNoGoal);
  if (!IsFinite(*there)) return Miss(kUnclearGoal);
  const Wish wish = DriveToGoal(steering.Get(), {.tolerance = goal_tolerance.Get()}, *here, *there);
  twist.Set(wish.twist);
  return Outcome{wish.rating > 0.0 ? activation : 0.0, wish.rating};
}

std::optional<Behaviour::Outcome> AvoidObstaclesBehaviour::Behave(double activation) {
  const auto view = surroundings_timeout.Read(surroundings, now());
  if (!view) return Miss(surroundings_timeout.words());
  const Wish wish = AvoidObstacles(steering.Get(), {.near_distance = near_distance.Get()}, *view);
  twist.Set(wish.twist);
  return Outcome{activation * wish.rating, wish.rating};
}

std::optional<Behaviour::Outcome> FollowWallBehaviour::Behave(double activation) {
  const auto view = surroundings_timeout.Read(surroundings, now());
  if (!view) return Miss(surroundings_timeout.words());
  const Wish wish = FollowWall(steering.Get(), {.first_turn = first_direction.Get()}, *view);
  twist.Set(wish.twist);
  return Outcome{activation, wish.rating};
}

std::optional<Behaviour::Outcome> EscapeBehaviour::Behave(double activation) {
  const auto here = pose_timeout.Read(pose, now());
  const auto there = goal.Read();
  const auto view = surroundings_timeout.Read(surroundings, now());
  if (!here) return Miss(pose_timeout.words());
  if (!view) return Miss(surroundings_timeout.words());
  if (!there) return Miss(kNoGoal);
  if (!IsFinite(*there)) return Miss(kUnclearGoal);
  const EscapeConfiguration configuration{
      .patience = patience.Get(), .margin = leave_margin.Get(), .tolerance = goal_tolerance.Get()};
  // While it could not tell, the robot stood.
  const double time_step = last_ ? std::min(ToSeconds(now() - *last_), surroundings_timeout.limit.Get()) : 0.0;
  last_ = now();
  // Who may do nothing, or may not move, waits for nothing; and a robot that looks at what lies before it does not come
  // nearer meanwhile.
  const bool may_move = activation > 0.0 && !runtime().robot_stop().in_force();
  const double passed = may_move ? time_step * (IsUnseenNear(*view) ? kWhileLooking : 1.0) : 0.0;
  const bool is_escaping = WatchProgress(configuration, passed, *here, *there, *view, state_);
  return Outcome{is_escaping ? activation : 0.0, is_escaping ? 1.0 : 0.0};
}

std::optional<Behaviour::Outcome> EmergencyStopBehaviour::Behave(double activation) {
  const auto view = surroundings_timeout.Read(surroundings, now());
  const auto others = wanted_timeout.Read(wanted, now());
  const auto here = pose_timeout.Read(pose, now());
  const bool must_know_where = view && view->is_vague;
  if (!view || !others || (must_know_where && !here)) {
    Warn(!view ? surroundings_timeout.words() : !others ? wanted_timeout.words() : pose_timeout.words());
    twist.Set({});
    return Outcome{activation, 1.0};
  }
  const Wish wish = EmergencyStop({.least_way = least_way.Get()}, here ? *here : Pose2{}, *view, *others, state_);
  twist.Set(wish.twist);
  return Outcome{activation * wish.rating, wish.rating};
}

}  // namespace runnel

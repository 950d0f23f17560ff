#include "modules/behaviours/robot_behaviours.h"

namespace runnel {

std::optional<Behaviour::Outcome> DriveToGoalBehaviour::Behave(double activation) {
  const auto here = pose.Read();
  const auto there = goal.Read();
  if (!here || !there) return Miss("nothing has come to its pose or its goal");
  DriveToGoalConfiguration configuration;
  configuration.tolerance = goal_tolerance.Get();
  const Wish wish = DriveToGoal(steering.Get(), configuration, *here, *there);
  twist.Set(wish.twist);
  return Outcome{wish.rating > 0.0 ? activation : 0.0, wish.rating};
}

std::optional<Behaviour::Outcome> AvoidObstaclesBehaviour::Behave(double activation) {
  const auto view = surroundings.Read();
  if (!view) return Miss("nothing has come to its surroundings");
  AvoidObstaclesConfiguration configuration;
  configuration.near_distance = near_distance.Get();
  const Wish wish = AvoidObstacles(steering.Get(), configuration, *view);
  twist.Set(wish.twist);
  return Outcome{activation * wish.rating, wish.rating};
}

std::optional<Behaviour::Outcome> FollowWallBehaviour::Behave(double activation) {
  const auto view = surroundings.Read();
  if (!view) return Miss("nothing has come to its surroundings");
  FollowWallConfiguration configuration;
  configuration.first_turn = first_direction.Get();
  const Wish wish = FollowWall(steering.Get(), configuration, *view);
  twist.Set(wish.twist);
  return Outcome{activation, wish.rating};
}

std::optional<Behaviour::Outcome> EscapeBehaviour::Behave(double activation) {
  const auto here = pose.Read();
  const auto there = goal.Read();
  const auto view = surroundings.Read();
  if (!here || !there || !view) return Miss("nothing has come to its pose, its goal or its surroundings");
  EscapeConfiguration configuration;
  configuration.patience = patience.Get();
  configuration.margin = leave_margin.Get();
  const double time_step = last_ ? ToSeconds(now() - *last_) : 0.0;
  last_ = now();
  // Who may do nothing waits for nothing.
  const double passed = activation > 0.0 ? time_step : 0.0;
  const bool is_escaping = WatchProgress(configuration, passed, *here, *there, *view, state_);
  return Outcome{is_escaping ? activation : 0.0, is_escaping ? 1.0 : 0.0};
}

std::optional<Behaviour::Outcome> EmergencyStopBehaviour::Behave(double activation) {
  const auto view = surroundings.Read();
  const auto others = wanted.Read();
  if (!view || !others) return Miss("nothing has come to its surroundings or what others want");
  if (ToSeconds(now() - view.timestamp()) > timeout.Get()) {
    twist.Set({});
    return Outcome{activation, 1.0};
  }
  const Wish wish = EmergencyStop({.least_way = least_way.Get()}, *view, *others);
  twist.Set(wish.twist);
  return Outcome{activation * wish.rating, wish.rating};
}

}  // namespace runnel

#include "modules/behaviours/algorithm/escape.h"

#include <algorithm>
#include <cmath>

#include "modules/behaviours/algorithm/steering.h"

namespace runnel {

namespace {

bool IsWayFree(const EscapeConfiguration& configuration, const Pose2& pose, Point2 goal, double distance,
               const Surroundings& surroundings) {
  const Point2 to_goal = ToBody(pose, goal);
  const double free = FreeRange(surroundings, std::atan2(to_goal.y, to_goal.x), PassingRadius(surroundings));
  return free >= std::min(configuration.free_way, distance);
}

}  // namespace

bool WatchProgress(const EscapeConfiguration& configuration, double time_step, const Pose2& pose, Point2 goal,
                   const Surroundings& surroundings, EscapeState& state) {
  const double distance = Distance(Position(pose), goal);
  if (!state.has_goal || !(state.goal == goal)) {
    state = {.has_goal = true, .goal = goal, .least_distance = distance};
  }
  if (distance < configuration.tolerance) {
    state.is_escaping = false;
    state.idle_time = 0.0;
    return false;
  }
  if (state.is_escaping) {
    const bool is_nearer = distance < state.stuck_distance - configuration.margin;
    if (is_nearer && IsWayFree(configuration, pose, goal, distance, surroundings)) {
      state.is_escaping = false;
      state.least_distance = distance;
      state.idle_time = 0.0;
    }
    return state.is_escaping;
  }
  if (distance < state.least_distance - configuration.progress) {
    state.least_distance = distance;
    state.idle_time = 0.0;
  } else {
    state.idle_time += time_step;
  }
  if (state.idle_time >= configuration.patience) {
    state.is_escaping = true;
    state.stuck_distance = std::min(distance, state.least_distance);
  }
  return state.is_escaping;
}

}  // namespace runnel

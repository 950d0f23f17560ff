#pragma once

#include <optional>

#include "modules/planning/algorithm/lap.h"
#include "modules/planning/algorithm/point_history.h"
#include "modules/planning/algorithm/wall_follower.h"
#include "modules/types/algorithm/planner_status.h"
#include "modules/types/algorithm/pose.h"
#include "modules/types/algorithm/surroundings.h"

namespace runnel {

/// What a planner is given in each update. A start or goal other than in the update before begins a
/// new task.
struct BugInput {
  double time_step = 0.0;  ///< s since the last update
  Pose2 pose;              ///< world
  Surroundings surroundings;
  Point2 start;  ///< m, world; where the M-line begins
  Point2 goal;   ///< m, world
};

/// Everything a Bug algorithm remembers. All variants record all of it, so that one variant can
/// take over from another in the middle of a task.
struct BugState {
  PlannerStatus status;
  bool has_task = false;
  Point2 start;
  Point2 goal;
  Pose2 last_pose;  ///< in the update before

  PointHistory hits;    ///< in the order they were met
  PointHistory leaves;  ///< without those that turned out to be none

  WallFollower follower;
  Lap lap;                            ///< since the last hit point
  double hit_distance = 0.0;          ///< m from the last hit point to the goal
  Point2 closest_point;               ///< nearest to the goal since the last hit point
  double closest_distance = 0.0;      ///< m, its distance to the goal
  double closest_length = 0.0;        ///< m, the lap's length there
  std::optional<Point2> crossing;     ///< of the M-line just behind, where it might leave
  std::optional<Point2> leave_point;  ///< found, not left yet
  double way_to_leave_point = 0.0;    ///< m along the boundary, when the robot set out
  bool is_on_last_stretch = false;    ///< straight to the leave point, no more along the boundary
  double set_out_length = 0.0;        ///< m, the path's length then
  int second_looks = 0;               ///< at hit points, after a lap, that found the way free
  Point2 progress_point;              ///< where the robot last got on
  double idle_time = 0.0;             ///< s since then
};

}  // namespace runnel

#pragma once

#include <cstdint>
#include <vector>

#include "modules/types/algorithm/pose.h"

namespace runnel {

enum class PlannerMode : std::uint8_t {
  kMotionToGoal,
  kFollowingBoundary,  ///< and looking for a leave point
  kGoingToLeavePoint,  ///< it is known, the robot is not there
  kFacingGoal,         ///< at the leave point, turning to see whether the way is free
  kReached,            ///< final: the robot stands within the goal tolerance
  kUnreachable,        ///< final: see Unreachability
};

enum class Unreachability : std::uint8_t {
  kNone,
  kEnclosed,    ///< no leave point all round an obstacle: the start or the goal is walled in, or the
                ///< goal is nearer to a wall than the robot's centre may come
  kNoProgress,  ///< back where it left an obstacle: there is a passage that the sensors show now
                ///< open, now closed
  kNoRoom,      ///< the robot cannot get away from where it is
};

/// What a planner tells about itself, copied freely.
struct PlannerStatus {
  PlannerMode mode = PlannerMode::kMotionToGoal;
  Unreachability unreachability = Unreachability::kNone;
  std::uint32_t hits = 0;         ///< hit points so far
  std::uint32_t leaves = 0;       ///< leave points so far
  double distance_to_goal = 0.0;  ///< m
  double path_length = 0.0;       ///< m driven since the task began
  Point2 hit_point = {};          ///< m, world; the last one, if hits > 0
  Point2 leave_point = {};        ///< m, world; the last one, if leaves > 0

  friend constexpr bool operator==(const PlannerStatus&, const PlannerStatus&) = default;
};

/// Where a planner of the Bug family met obstacles and where it left them, in order, since its task
/// began; m, world. hits[i] belongs to leaves[i]; while the robot is at an obstacle there is one
/// hit more.
struct HitAndLeavePoints {
  std::vector<Point2> hits;
  std::vector<Point2> leaves;

  friend bool operator==(const HitAndLeavePoints&, const HitAndLeavePoints&) = default;
};

}  // namespace runnel

#pragma once

#include "core/types/type_of.h"
#include "modules/types/algorithm/planner_status.h"
#include "modules/types/pose.h"

namespace runnel {

inline void Describe(TypeBuilder<PlannerMode>& type) {
  type.Name("PlannerMode")
      .Value("motion_to_goal", PlannerMode::kMotionToGoal)
      .Value("following_boundary", PlannerMode::kFollowingBoundary)
      .Value("going_to_leave_point", PlannerMode::kGoingToLeavePoint)
      .Value("facing_goal", PlannerMode::kFacingGoal)
      .Value("reached", PlannerMode::kReached)
      .Value("unreachable", PlannerMode::kUnreachable);
}

inline void Describe(TypeBuilder<Unreachability>& type) {
  type.Name("Unreachability")
      .Value("none", Unreachability::kNone)
      .Value("enclosed", Unreachability::kEnclosed)
      .Value("no_progress", Unreachability::kNoProgress)
      .Value("no_room", Unreachability::kNoRoom);
}

inline void Describe(TypeBuilder<PlannerStatus>& type) {
  type.Name("PlannerStatus")
      .Field("mode", &PlannerStatus::mode)
      .Field("unreachability", &PlannerStatus::unreachability)
      .Field("hits", &PlannerStatus::hits)
      .Field("leaves", &PlannerStatus::leaves)
      .Field("distance_to_goal", &PlannerStatus::distance_to_goal, {.unit = "m"})
      .Field("path_length", &PlannerStatus::path_length, {.unit = "m"})
      .Field("hit_point", &PlannerStatus::hit_point)
      .Field("leave_point", &PlannerStatus::leave_point);
}

}  // namespace runnel

#pragma once

#include "core/types/builtin_types.h"
#include "core/types/type_of.h"
#include "modules/types/algorithm/planner_status.h"
#include "modules/types/pose.h"

namespace runnel {

inline void Describe(TypeBuilder<PlannerMode>& type) {
  type.Name("PlannerMode")
      .Values<PlannerMode::kMotionToGoal, PlannerMode::kFollowingBoundary, PlannerMode::kGoingToLeavePoint,
              PlannerMode::kFacingGoal, PlannerMode::kReached, PlannerMode::kUnreachable>();
}

inline void Describe(TypeBuilder<Unreachability>& type) {
  type.Name("Unreachability")
      .Values<Unreachability::kNone, Unreachability::kEnclosed, Unreachability::kNoProgress, Unreachability::kNoRoom>();
}

inline void Describe(TypeBuilder<PlannerStatus>& type) {
  type.Name("PlannerStatus")
      .Fields<&PlannerStatus::mode, &PlannerStatus::unreachability, &PlannerStatus::hits, &PlannerStatus::leaves>()
      .Fields<&PlannerStatus::distance_to_goal, &PlannerStatus::path_length>({.unit = "m"})
      .Fields<&PlannerStatus::hit_point, &PlannerStatus::leave_point>();
}

inline void Describe(TypeBuilder<HitAndLeavePoints>& type) {
  type.Name("HitAndLeavePoints")
      .SemanticTag("hit_and_leave_points")
      .Fields<&HitAndLeavePoints::hits, &HitAndLeavePoints::leaves>();
}

}  // namespace runnel

#pragma once

#include "core/types/type_of.h"
#include "modules/planning/algorithm/bug_components.h"

namespace runnel {

inline void Describe(TypeBuilder<BoundaryDirection>& type) {
  type.Name("BoundaryDirection")
      .Value("left", BoundaryDirection::kLeft)
      .Value("right", BoundaryDirection::kRight);
}

inline void Describe(TypeBuilder<MotionKind>& type) {
  type.Name("MotionKind")
      .Value("straight", MotionKind::kStraight)
      .Value("m_line", MotionKind::kMLine)
      .Value("tangent", MotionKind::kTangent);
}

inline void Describe(TypeBuilder<DirectionKind>& type) {
  type.Name("DirectionKind")
      .Value("left", DirectionKind::kLeft)
      .Value("right", DirectionKind::kRight)
      .Value("local", DirectionKind::kLocal)
      .Value("alternate", DirectionKind::kAlternate);
}

inline void Describe(TypeBuilder<LeaveKind>& type) {
  type.Name("LeaveKind")
      .Value("best_after_lap", LeaveKind::kBestAfterLap)
      .Value("m_line_closer_than_hit", LeaveKind::kMLineCloserThanHit)
      .Value("m_line_closest_so_far", LeaveKind::kMLineClosestSoFar)
      .Value("closest_so_far", LeaveKind::kClosestSoFar)
      .Value("free_range_step", LeaveKind::kFreeRangeStep)
      .Value("reach_below_followed", LeaveKind::kReachBelowFollowed)
      .Value("closer_than_hit", LeaveKind::kCloserThanHit)
      .Value("free", LeaveKind::kFree);
}

inline void Describe(TypeBuilder<RevisitKind>& type) {
  type.Name("RevisitKind")
      .Value("none", RevisitKind::kNone)
      .Value("reverse_at_visited", RevisitKind::kReverseAtVisited);
}

}  // namespace runnel

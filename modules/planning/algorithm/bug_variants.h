#pragma once

#include <array>
#include <string_view>

#include "modules/planning/algorithm/bug_components.h"

namespace runnel {

/// A published variant of the Bug family.
struct BugVariant {
  std::string_view name;
  std::string_view description;
  BugComposition composition;
};

/// All of them. Where a direction is 'left', the variant always turns the same way, left or right
/// as it is told.
inline constexpr std::array<BugVariant, 10> kBugVariants = {{
    // Lumelsky, Stepanov 1984
    {"bug1",
     "goes once round each obstacle, leaves where it was nearest to the goal",
     {MotionKind::kStraight, DirectionKind::kLeft, LeaveKind::kBestAfterLap, RevisitKind::kNone}},
    // Lumelsky, Stepanov 1986
    {"bug2",
     "leaves obstacles where it meets the line from start to goal again",
     {MotionKind::kMLine, DirectionKind::kLeft, LeaveKind::kMLineCloserThanHit, RevisitKind::kNone}},
    // Sankaranarayanan, Vidyasagar 1990
    {"alg1",
     "as bug2, but nearer than ever on the line, and turns round where it was before",
     {MotionKind::kMLine, DirectionKind::kLeft, LeaveKind::kMLineClosestSoFar, RevisitKind::kReverseAtVisited}},
    {"alg2",
     "leaves obstacles where it is nearer to the goal than ever, turns round where it was before",
     {MotionKind::kStraight, DirectionKind::kLeft, LeaveKind::kClosestSoFar, RevisitKind::kReverseAtVisited}},
    // Kamon, Rivlin 1995
    {"dist_bug",
     "leaves obstacles where it sees the goal, or sees that it gets nearer by a step",
     {MotionKind::kStraight, DirectionKind::kLocal, LeaveKind::kFreeRangeStep, RevisitKind::kNone}},
    // Kamon, Rimon, Rivlin 1998
    {"tangent_bug",
     "drives to the edges of obstacles it sees, leaves where it sees a point nearer to the goal",
     {MotionKind::kTangent, DirectionKind::kLocal, LeaveKind::kReachBelowFollowed, RevisitKind::kNone}},
    // Noborio 2000; Horiuchi, Noborio 2001
    {"rev1",
     "as alg1, but turns left and right at obstacles by turns",
     {MotionKind::kMLine, DirectionKind::kAlternate, LeaveKind::kMLineClosestSoFar, RevisitKind::kReverseAtVisited}},
    {"rev2",
     "as alg2, but turns left and right at obstacles by turns",
     {MotionKind::kStraight, DirectionKind::kAlternate, LeaveKind::kClosestSoFar, RevisitKind::kReverseAtVisited}},
    {"class1",
     "leaves obstacles where it is nearer to the goal than where it hit them",
     {MotionKind::kStraight, DirectionKind::kLeft, LeaveKind::kCloserThanHit, RevisitKind::kNone}},
    {"com",
     "leaves obstacles wherever the way to the goal is free; may go in circles for ever",
     {MotionKind::kStraight, DirectionKind::kLeft, LeaveKind::kFree, RevisitKind::kNone}},
}};

}  // namespace runnel

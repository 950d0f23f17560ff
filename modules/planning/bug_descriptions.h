#pragma once

#include <cstddef>
#include <string>

#include "core/types/builtin_types.h"
#include "core/types/type_of.h"
#include "modules/planning/algorithm/bug_components.h"
#include "modules/planning/algorithm/bug_state.h"
#include "modules/types/planner_status.h"
#include "modules/types/pose.h"

namespace runnel {

inline void Describe(TypeBuilder<BoundaryDirection>& type) {
  type.Name("BoundaryDirection").Values<BoundaryDirection::kLeft, BoundaryDirection::kRight>();
}

/// The values of `Kind` bear the names of the components, which are in the same order.
template <typename Kind, typename Components>
void DescribeKinds(TypeBuilder<Kind>& type, const char* name, const Components& components) {
  type.Name(name);
  for (std::size_t i = 0; i < components.size(); ++i) {
    type.Value(std::string(components[i]->name()), static_cast<Kind>(i));
  }
}

inline void Describe(TypeBuilder<MotionKind>& type) { DescribeKinds(type, "MotionKind", AllMotions()); }
inline void Describe(TypeBuilder<DirectionKind>& type) { DescribeKinds(type, "DirectionKind", AllDirections()); }
inline void Describe(TypeBuilder<LeaveKind>& type) { DescribeKinds(type, "LeaveKind", AllLeaveConditions()); }
inline void Describe(TypeBuilder<RevisitKind>& type) { DescribeKinds(type, "RevisitKind", AllRevisits()); }

// What a planner remembers, field by field, so that it can go on in a library that was built anew. A field that is
// missing here is lost then.

/// Names the parts that only their classes know.
struct KeptFields {
  static void Describe(TypeBuilder<PointHistory>& type) {
    type.Name("PointHistory").Fields<&PointHistory::points_, &PointHistory::total_, &PointHistory::size_>();
  }
  static void Describe(TypeBuilder<FacedHeadings>& type) {
    type.Name("FacedHeadings")
        .Fields<&FacedHeadings::place_, &FacedHeadings::heading_, &FacedHeadings::left_, &FacedHeadings::right_>();
  }
  static void Describe(TypeBuilder<WallFollower>& type) {
    type.Name("WallFollower")
        .Fields<&WallFollower::direction_, &WallFollower::is_turning_, &WallFollower::target_heading_,
                &WallFollower::is_cautious_, &WallFollower::turning_place_, &WallFollower::turn_sign_,
                &WallFollower::is_looking_, &WallFollower::looked_round_, &WallFollower::look_to_,
                &WallFollower::last_heading_, &WallFollower::contact_bearing_>();
  }
  using Gate = Lap::Gate;
  static void Describe(TypeBuilder<Gate>& type) {
    type.Name("Lap::Gate").Fields<&Gate::pose, &Gate::length, &Gate::turned>();
  }
  static void Describe(TypeBuilder<Lap>& type) {
    type.Name("Lap")
        .Fields<&Lap::hit_, &Lap::last_, &Lap::gate_, &Lap::second_gate_, &Lap::has_gate_, &Lap::is_complete_,
                &Lap::is_circling_, &Lap::length_, &Lap::turned_>();
  }
};

template <typename T>
requires requires(TypeBuilder<T>& type) { KeptFields::Describe(type); }
void Describe(TypeBuilder<T>& type) { KeptFields::Describe(type); }

inline void Describe(TypeBuilder<Approach>& type) {
  type.Name("Approach").Values<Approach::kNear, Approach::kAlongBoundary, Approach::kAcross, Approach::kBack>();
}

inline void Describe(TypeBuilder<BugState>& type) {
  type.Name("BugState")
      .Fields<&BugState::status, &BugState::has_task, &BugState::start, &BugState::goal, &BugState::composition,
              &BugState::last_pose, &BugState::last_twist, &BugState::still_pose, &BugState::commanded,
              &BugState::earlier_turn, &BugState::turning, &BugState::response, &BugState::hits, &BugState::leaves,
              &BugState::least_distance_of_all, &BugState::line_start, &BugState::least_distance_on_line,
              &BugState::last_leave_distance, &BugState::last_direction, &BugState::node_side, &BugState::second_looks,
              &BugState::doubted_hit_distance, &BugState::faced, &BugState::look, &BugState::look_back,
              &BugState::progress_point, &BugState::idle_time, &BugState::refused_at, &BugState::follower,
              &BugState::hit_distance, &BugState::least_distance, &BugState::followed_distance, &BugState::has_reversed,
              &BugState::has_doubted, &BugState::lap, &BugState::is_other_loop, &BugState::closest_point,
              &BugState::closest_distance, &BugState::closest_length, &BugState::crossing, &BugState::leave_point,
              &BugState::approach, &BugState::is_last_chance, &BugState::way_to_leave_point,
              &BugState::is_on_last_stretch, &BugState::set_out_point, &BugState::is_off_boundary,
              &BugState::set_out_contact, &BugState::set_out_at>();
}

}  // namespace runnel

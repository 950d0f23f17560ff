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
  type.Name("BoundaryDirection").Value("left", BoundaryDirection::kLeft).Value("right", BoundaryDirection::kRight);
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
    type.Name("PointHistory")
        .Field("points", &PointHistory::points_)
        .Field("total", &PointHistory::total_)
        .Field("size", &PointHistory::size_);
  }
  static void Describe(TypeBuilder<FacedHeadings>& type) {
    type.Name("FacedHeadings")
        .Field("place", &FacedHeadings::place_)
        .Field("heading", &FacedHeadings::heading_)
        .Field("left", &FacedHeadings::left_)
        .Field("right", &FacedHeadings::right_);
  }
  static void Describe(TypeBuilder<WallFollower>& type) {
    type.Name("WallFollower")
        .Field("direction", &WallFollower::direction_)
        .Field("is_turning", &WallFollower::is_turning_)
        .Field("target_heading", &WallFollower::target_heading_)
        .Field("is_cautious", &WallFollower::is_cautious_)
        .Field("turning_place", &WallFollower::turning_place_)
        .Field("turn_sign", &WallFollower::turn_sign_)
        .Field("is_looking", &WallFollower::is_looking_)
        .Field("looked_round", &WallFollower::looked_round_)
        .Field("look_to", &WallFollower::look_to_)
        .Field("last_heading", &WallFollower::last_heading_)
        .Field("contact_bearing", &WallFollower::contact_bearing_);
  }
  using Gate = Lap::Gate;
  static void Describe(TypeBuilder<Gate>& type) {
    type.Name("Lap::Gate").Field("pose", &Gate::pose).Field("length", &Gate::length).Field("turned", &Gate::turned);
  }
  static void Describe(TypeBuilder<Lap>& type) {
    type.Name("Lap")
        .Field("hit", &Lap::hit_)
        .Field("last", &Lap::last_)
        .Field("gate", &Lap::gate_)
        .Field("second_gate", &Lap::second_gate_)
        .Field("has_gate", &Lap::has_gate_)
        .Field("is_complete", &Lap::is_complete_)
        .Field("is_circling", &Lap::is_circling_)
        .Field("length", &Lap::length_)
        .Field("turned", &Lap::turned_);
  }
};

template <typename T>
requires requires(TypeBuilder<T>& type) { KeptFields::Describe(type); }
void Describe(TypeBuilder<T>& type) { KeptFields::Describe(type); }

inline void Describe(TypeBuilder<Approach>& type) {
  type.Name("Approach")
      .Value("near", Approach::kNear)
      .Value("along_boundary", Approach::kAlongBoundary)
      .Value("across", Approach::kAcross)
      .Value("back", Approach::kBack);
}

inline void Describe(TypeBuilder<BugState>& type) {
  type.Name("BugState")
      .Field("status", &BugState::status)
      .Field("has_task", &BugState::has_task)
      .Field("start", &BugState::start)
      .Field("goal", &BugState::goal)
      .Field("composition", &BugState::composition)
      .Field("last_pose", &BugState::last_pose)
      .Field("last_twist", &BugState::last_twist)
      .Field("still_pose", &BugState::still_pose)
      .Field("commanded", &BugState::commanded)
      .Field("hits", &BugState::hits)
      .Field("leaves", &BugState::leaves)
      .Field("least_distance_of_all", &BugState::least_distance_of_all)
      .Field("line_start", &BugState::line_start)
      .Field("least_distance_on_line", &BugState::least_distance_on_line)
      .Field("last_leave_distance", &BugState::last_leave_distance)
      .Field("last_direction", &BugState::last_direction)
      .Field("node_side", &BugState::node_side)
      .Field("second_looks", &BugState::second_looks)
      .Field("doubted_hit_distance", &BugState::doubted_hit_distance)
      .Field("faced", &BugState::faced)
      .Field("look", &BugState::look)
      .Field("look_back", &BugState::look_back)
      .Field("progress_point", &BugState::progress_point)
      .Field("idle_time", &BugState::idle_time)
      .Field("refused_at", &BugState::refused_at)
      .Field("follower", &BugState::follower)
      .Field("hit_distance", &BugState::hit_distance)
      .Field("least_distance", &BugState::least_distance)
      .Field("followed_distance", &BugState::followed_distance)
      .Field("has_reversed", &BugState::has_reversed)
      .Field("has_doubted", &BugState::has_doubted)
      .Field("lap", &BugState::lap)
      .Field("is_other_loop", &BugState::is_other_loop)
      .Field("closest_point", &BugState::closest_point)
      .Field("closest_distance", &BugState::closest_distance)
      .Field("closest_length", &BugState::closest_length)
      .Field("crossing", &BugState::crossing)
      .Field("leave_point", &BugState::leave_point)
      .Field("approach", &BugState::approach)
      .Field("is_last_chance", &BugState::is_last_chance)
      .Field("way_to_leave_point", &BugState::way_to_leave_point)
      .Field("is_on_last_stretch", &BugState::is_on_last_stretch)
      .Field("set_out_point", &BugState::set_out_point)
      .Field("is_off_boundary", &BugState::is_off_boundary)
      .Field("set_out_contact", &BugState::set_out_contact)
      .Field("set_out_at", &BugState::set_out_at);
}

}  // namespace runnel

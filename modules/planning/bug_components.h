#pragma once

#include <cstddef>
#include <string>

#include "core/types/type_of.h"
#include "modules/planning/algorithm/bug_components.h"

namespace runnel {

inline void Describe(TypeBuilder<BoundaryDirection>& type) {
  type.Name("BoundaryDirection")
      .Value("left", BoundaryDirection::kLeft)
      .Value("right", BoundaryDirection::kRight);
}

/// The values of `Kind` bear the names of the components, which are in the same order.
template <typename Kind, typename Components>
void DescribeKinds(TypeBuilder<Kind>& type, const char* name, const Components& components) {
  type.Name(name);
  for (std::size_t i = 0; i < components.size(); ++i) {
    type.Value(std::string(components[i]->name()), static_cast<Kind>(i));
  }
}

inline void Describe(TypeBuilder<MotionKind>& type) {
  DescribeKinds(type, "MotionKind", AllMotions());
}
inline void Describe(TypeBuilder<DirectionKind>& type) {
  DescribeKinds(type, "DirectionKind", AllDirections());
}
inline void Describe(TypeBuilder<LeaveKind>& type) {
  DescribeKinds(type, "LeaveKind", AllLeaveConditions());
}
inline void Describe(TypeBuilder<RevisitKind>& type) {
  DescribeKinds(type, "RevisitKind", AllRevisits());
}

}  // namespace runnel

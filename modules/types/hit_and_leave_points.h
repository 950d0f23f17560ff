#pragma once

#include "core/types/builtin_types.h"
#include "core/types/type_of.h"
#include "modules/types/algorithm/hit_and_leave_points.h"
#include "modules/types/pose.h"

namespace runnel {

inline void Describe(TypeBuilder<HitAndLeavePoints>& type) {
  type.Name("HitAndLeavePoints")
      .SemanticTag("hit_and_leave_points")
      .Fields<&HitAndLeavePoints::hits, &HitAndLeavePoints::leaves>();
}

}  // namespace runnel

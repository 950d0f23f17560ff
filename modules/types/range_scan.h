#pragma once

#include "core/types/type_of.h"
#include "modules/types/algorithm/range_scan.h"

namespace runnel {

inline void Describe(TypeBuilder<RangeScan>& type) {
  type.Name("RangeScan")
      .SemanticTag("range_scan")
      .Fields<&RangeScan::start_angle, &RangeScan::angle_step>({.unit = "rad"})
      .Fields<&RangeScan::range_minimum, &RangeScan::range_maximum, &RangeScan::ranges>({.unit = "m"});
}

}  // namespace runnel

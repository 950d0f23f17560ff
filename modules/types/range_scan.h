#pragma once

#include "core/types/type_of.h"
#include "modules/types/algorithm/range_scan.h"

namespace runnel {

inline void Describe(TypeBuilder<RangeScan>& type) {
  type.Name("RangeScan")
      .SemanticTag("range_scan")
      .Field("start_angle", &RangeScan::start_angle, {.unit = "rad"})
      .Field("angle_step", &RangeScan::angle_step, {.unit = "rad"})
      .Field("range_minimum", &RangeScan::range_minimum, {.unit = "m"})
      .Field("range_maximum", &RangeScan::range_maximum, {.unit = "m"})
      .Field("ranges", &RangeScan::ranges, {.unit = "m"});
}

}  // namespace runnel

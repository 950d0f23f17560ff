#pragma once

#include "core/types/type_of.h"
#include "modules/types/algorithm/infrared_ranges.h"

namespace runnel {

inline void Describe(TypeBuilder<InfraredRanges>& type) {
  type.Name("InfraredRanges")
      .Fields<&InfraredRanges::front, &InfraredRanges::left, &InfraredRanges::right, &InfraredRanges::range_maximum>(
          {.unit = "m"})
      .Field("field_of_view", &InfraredRanges::field_of_view, {.unit = "rad"});
}

}  // namespace runnel

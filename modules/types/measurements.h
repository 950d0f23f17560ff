#pragma once

#include "core/types/builtin_types.h"
#include "core/types/shared_vector_types.h"
#include "core/types/type_of.h"
#include "modules/types/algorithm/measurements.h"

namespace runnel {

inline void Describe(TypeBuilder<RangeScan>& type) {
  type.Name("RangeScan")
      .SemanticTag("range_scan")
      .Fields<&RangeScan::start_angle, &RangeScan::angle_step>({.unit = "rad"})
      .Fields<&RangeScan::range_minimum, &RangeScan::range_maximum, &RangeScan::ranges>({.unit = "m"});
}

inline void Describe(TypeBuilder<InfraredRanges>& type) {
  type.Name("InfraredRanges")
      .Fields<&InfraredRanges::front, &InfraredRanges::left, &InfraredRanges::right, &InfraredRanges::range_maximum>(
          {.unit = "m"})
      .Field("field_of_view", &InfraredRanges::field_of_view, {.unit = "rad"});
}

inline void Describe(TypeBuilder<Contact>& type) {
  type.Name("Contact")
      .SemanticTag("contact")
      .Field("is_touching", &Contact::is_touching)
      .Field("bearing", &Contact::bearing, {.unit = "rad"});
}

inline void Describe(TypeBuilder<Image>& type) {
  type.Name("Image")
      .SemanticTag("image")
      .Fields<&Image::width, &Image::height, &Image::encoding>()
      .Field("row_stride", &Image::row_stride, {.description = "bytes from row to row"})
      .Field("data", &Image::data);
}

}  // namespace runnel

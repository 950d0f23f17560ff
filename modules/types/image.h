#pragma once

#include "core/types/builtin_types.h"
#include "core/types/shared_vector_types.h"
#include "core/types/type_of.h"
#include "modules/types/algorithm/image.h"

namespace runnel {

inline void Describe(TypeBuilder<Image>& type) {
  type.Name("Image")
      .SemanticTag("image")
      .Fields<&Image::width, &Image::height, &Image::encoding>()
      .Field("row_stride", &Image::row_stride, {.description = "bytes from row to row"})
      .Field("data", &Image::data);
}

}  // namespace runnel

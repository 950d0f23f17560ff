#pragma once

#include "core/types/builtin_types.h"
#include "core/types/type_of.h"
#include "modules/types/algorithm/path.h"
#include "modules/types/pose.h"

namespace runnel {

inline void Describe(TypeBuilder<Path2>& type) {
  type.Name("Path2").SemanticTag("path").Field("points", &Path2::points, {.unit = "m"});
}

}  // namespace runnel

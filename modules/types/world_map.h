#pragma once

#include "core/types/builtin_types.h"
#include "core/types/type_of.h"
#include "modules/types/algorithm/world_map.h"
#include "modules/types/pose.h"

namespace runnel {

inline void Describe(TypeBuilder<MapOutline>& type) {
  type.Name("MapOutline")
      .Fields<&MapOutline::points, &MapOutline::height>({.unit = "m"})
      .Field("is_hole", &MapOutline::is_hole, {.description = "within the outlines that come before it"});
}

inline void Describe(TypeBuilder<WorldMap>& type) {
  type.Name("WorldMap")
      .SemanticTag("world_map")
      .Fields<&WorldMap::name, &WorldMap::start, &WorldMap::goal, &WorldMap::outlines>()
      .Field("bounds", &WorldMap::bounds, {.unit = "m"});
}

}  // namespace runnel

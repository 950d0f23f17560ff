#pragma once

#include "core/types/type_of.h"
#include "modules/types/algorithm/surroundings.h"

namespace runnel {

inline void Describe(TypeBuilder<Surroundings>& type) {
  type.Name("Surroundings")
      .Fields<&Surroundings::sensor_range, &Surroundings::safe_distance>({.unit = "m"})
      .Field("is_vague", &Surroundings::is_vague,
             {.description = "whether the sensor cannot tell where in a cone an echo came from"})
      .Field("is_measured", &Surroundings::is_measured, {.description = "false as long as the sensor has said nothing"})
      .Field("unseen_sector", &Surroundings::unseen_sector,
             {.description = "where ahead no sensor has looked yet, and the body would get to"})
      .Field("unseen_after", &Surroundings::unseen_after,
             {.unit = "mm/4", .description = "of the way ahead, 65535 for none"})
      .Field("contour", &Surroundings::contour,
             {.unit = "mm/4", .description = "nearest boundary in each sector, 65535 for none"});
}

}  // namespace runnel

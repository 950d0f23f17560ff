#pragma once

#include "core/types/type_of.h"
#include "modules/types/algorithm/wheel_speeds.h"

namespace runnel {

inline void Describe(TypeBuilder<WheelSpeeds>& type) {
  type.Name("WheelSpeeds").Fields<&WheelSpeeds::left, &WheelSpeeds::right>({.unit = "rad/s"});
}

}  // namespace runnel

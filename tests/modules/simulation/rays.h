#pragma once

#include <limits>

#include "modules/simulation/algorithm/ray_caster.h"
#include "modules/simulation/algorithm/world_geometry.h"

namespace runnel {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kEye = 0.2;  ///< m, above the ground

/// As a sensor on the robot sees `world`.
inline RayCaster Rays(const World& world) { return RayCaster(OutlineOf(world), kEye); }

}  // namespace runnel

#pragma once

#include <memory>

#include "core/types/type_of.h"
#include "modules/simulation/algorithm/ray_caster.h"
#include "modules/simulation/algorithm/world.h"

namespace runnel {

/// The part of a simulated world that stands still, as it travels from the world to the modules
/// that look at it: sensors, referees.
///
/// Ownership:  shared; it lives as long as anybody looks at it.
/// Threads:    never changes; any thread.
struct Scene {
  std::shared_ptr<const World> world;
  std::shared_ptr<const RayCaster> rays;  ///< what a sensor at the robot's height can see
  double robot_radius = 0.0;              ///< m
};

inline void Describe(TypeBuilder<Scene>& type) { type.Name("Scene"); }

}  // namespace runnel

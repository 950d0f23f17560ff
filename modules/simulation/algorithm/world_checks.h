#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "modules/simulation/algorithm/world.h"

namespace runnel {

enum class WorldPart { kStart, kGoal, kPolygon, kHole, kBox, kCylinder, kWall, kBounds };

/// Something wrong with a world, and with which part of it, so that who made the world (a file, a
/// program) can find the place again.
struct WorldFault {
  WorldPart part = WorldPart::kStart;
  std::size_t index = 0;  ///< among the obstacles of this kind; of the polygon, for a hole
  std::size_t hole = 0;   ///< which hole of the polygon
  std::string message;    ///< one sentence, without a full stop

  friend bool operator==(const WorldFault&, const WorldFault&) = default;
};

/// Everything about the world's geometry that cannot be simulated: numbers that are not finite,
/// sizes that are not positive, rings of fewer than three points or that touch or cross themselves,
/// holes that are not within their polygon or meet each other, a start that is inside an obstacle
/// or outside the bounds. Empty for a good world. A goal that cannot be reached is no fault.
///
/// Obstacles may overlap each other. Of each ring the first crossing found is told, not all.
[[nodiscard]] std::vector<WorldFault> FaultsOf(const World& world);

}  // namespace runnel

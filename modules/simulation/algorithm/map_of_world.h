#pragma once

#include "modules/simulation/algorithm/world.h"
#include "modules/types/algorithm/world_map.h"

namespace runnel {

/// The world as closed lines: a box as its corners, a cylinder and the round ends and corners of walls
/// as polygons that touch the circle from within.
[[nodiscard]] WorldMap MapOf(const World& world);

/// All that is within half a thickness of the open line, as one closed line round it. Where a wall
/// bends back into itself the line may cross itself; what it winds round at all is wall (the non-zero
/// rule). Empty for a wall of fewer than two points, which is none.
[[nodiscard]] Ring LineRound(const WallObstacle& wall);

}  // namespace runnel

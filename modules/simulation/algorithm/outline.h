#pragma once

#include <vector>

#include "modules/simulation/algorithm/world.h"
#include "modules/types/algorithm/drawing.h"
#include "modules/types/algorithm/segment.h"

namespace runnel {

/// The ground plan of everything in a world that stops a body or a ray of light, as flat and as
/// round upright surfaces. Pieces may reach into an obstacle (where a wall bends), never out of it.
struct Outline {
  struct Flat {
    Segment2 ground;
    double height = 0.0;  ///< m
  };
  struct Round {
    Point2 centre;
    double radius = 0.0;  ///< m
    double height = 0.0;  ///< m
  };

  std::vector<Flat> flats;
  std::vector<Round> rounds;
};

/// Bounds have no height of their own: they take `bounds_height` (m).
[[nodiscard]] Outline OutlineOf(const World& world, double bounds_height = kDefaultObstacleHeight);

/// An upright rectangle, in m.
struct Extent {
  Point2 low;
  Point2 high;

  /// With `reach` on all sides of the point. One that is not finite is left out.
  void Include(Point2 point, double reach = 0.0);
};

/// Everything that stands in the world, and its start and goal.
[[nodiscard]] Extent ExtentOf(const World& world);

/// The rectangle that a piece of a wall stands on, without the round ends.
[[nodiscard]] BoxObstacle StraightPart(const Segment2& piece, double thickness, double height);

/// The world as closed lines: a box as its corners, a cylinder and the round ends and corners of walls
/// as polygons that touch the circle from within.
[[nodiscard]] WorldMap MapOf(const World& world);

/// All that is within half a thickness of the open line, as one closed line round it. Where a wall
/// bends back into itself the line may cross itself; what it winds round at all is wall (the non-zero
/// rule). Empty for a wall of fewer than two points, which is none.
[[nodiscard]] Ring LineRound(const WallObstacle& wall);

}  // namespace runnel

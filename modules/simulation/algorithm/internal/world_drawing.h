#pragma once

#include "modules/simulation/algorithm/internal/canvas.h"

namespace runnel::internal {

/// The ground with its grid.
void DrawFloor(Canvas& canvas);

/// Edges of all first, then all that is solid, so that obstacles that overlap become one; last the
/// frame of the plot.
void DrawObstacles(const World& world, Canvas& canvas);

/// Below the plot, at the right.
void DrawScaleBar(Canvas& canvas);

}  // namespace runnel::internal

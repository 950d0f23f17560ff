#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "modules/simulation/algorithm/internal/canvas.h"
#include "modules/simulation/algorithm/trajectory_svg.h"

namespace runnel::internal {

/// The ground with its grid.
void DrawFloor(Canvas& canvas);

/// Edges of all first, then all that is solid, so that obstacles that overlap become one; last the
/// frame of the plot.
void DrawObstacles(const World& world, Canvas& canvas);

/// Below the plot, at the right.
void DrawScaleBar(Canvas& canvas);

struct ModeLook {
  PathMode mode;
  std::string_view colour;
  std::string_view label;
};
inline constexpr std::array<ModeLook, 3> kModes = {
    {{PathMode::kDrivingToGoal, "#2468d6", "driving to the goal"},
     {PathMode::kFollowingWall, "#e07b1a", "following a wall"},
     {PathMode::kGoingToLeavePoint, "#139c8f", "going to the leave point"}}};

/// The path coloured by mode, with arrows along it.
void DrawPath(const std::vector<PathSample>& path, Canvas& canvas);

}  // namespace runnel::internal

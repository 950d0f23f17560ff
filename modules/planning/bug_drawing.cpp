#include "modules/planning/bug_drawing.h"

#include <cmath>
#include <utility>
#include <vector>

namespace runnel {

namespace {

// Seen on light and on dark ground.
constexpr DrawnColour kLine{.red = 0.56, .green = 0.42, .blue = 0.86, .alpha = 0.7};
constexpr DrawnColour kBoundary{.red = 0.9, .green = 0.5, .blue = 0.1, .alpha = 0.8};
constexpr DrawnColour kLeaving{.red = 0.15, .green = 0.6, .blue = 0.4, .alpha = 0.9};

std::vector<Point2> BoundaryPoints(const Pose2& pose, const Surroundings& surroundings) {
  std::vector<Point2> points;
  for (int sector = 0; sector < Surroundings::kSectors; ++sector) {
    const double distance = ContourDistance(surroundings, sector);
    if (!std::isfinite(distance)) continue;
    const double bearing = pose.heading + SectorBearing(sector);
    points.push_back(
        {pose.x + distance * std::cos(bearing), pose.y + distance * std::sin(bearing)});
  }
  return points;
}

}  // namespace

Drawing DrawBugState(const BugState& state, const Pose2& pose, const Surroundings& surroundings) {
  Drawing drawing;
  drawing.AddLine({state.line_start, state.goal}, kLine, 0.025);
  if (auto points = BoundaryPoints(pose, surroundings); !points.empty()) {
    drawing.AddPoints(std::move(points), kBoundary, 0.07);
  }
  if (state.closest_distance < BugState::kNever) {
    drawing.AddPoints({state.closest_point}, kLeaving, 0.14);
  }
  if (state.leave_point) {
    drawing.AddLine({Position(pose), *state.leave_point}, kLeaving, 0.03);
  }
  return drawing;
}

}  // namespace runnel

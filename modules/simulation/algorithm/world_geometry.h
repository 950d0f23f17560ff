#pragma once

#include <vector>

#include "modules/simulation/algorithm/world.h"
#include "modules/types/algorithm/segment.h"

namespace runnel {

/// The four corners, counter-clockwise.
[[nodiscard]] Ring CornersOf(const BoxObstacle& box);

/// The sides of a closed line, in its order.
[[nodiscard]] std::vector<Segment2> SidesOf(const Ring& ring);

/// The pieces of an open line, in its order; empty for fewer than two points.
[[nodiscard]] std::vector<Segment2> PiecesOf(const std::vector<Point2>& line);

/// Whether the point is within a simple ring. A point on the line itself may count either way.
[[nodiscard]] bool Contains(const Ring& ring, Point2 point);

/// Distance to the surface in m, negative inside. The ring must have a point.
[[nodiscard]] double SignedDistance(const Ring& ring, Point2 point);
[[nodiscard]] double SignedDistance(const PolygonObstacle& polygon, Point2 point);
[[nodiscard]] double SignedDistance(const BoxObstacle& box, Point2 point);
[[nodiscard]] double SignedDistance(const CylinderObstacle& cylinder, Point2 point);
[[nodiscard]] double SignedDistance(const WallObstacle& wall, Point2 point);

/// How far the point is from the nearest obstacle or from the bounds, in m; negative inside an
/// obstacle or outside the bounds, +infinity in a world without any. A round robot fits where this
/// is at least its radius.
[[nodiscard]] double ClearanceAt(const World& world, Point2 point);

}  // namespace runnel

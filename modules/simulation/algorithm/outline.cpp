#include "modules/simulation/algorithm/outline.h"

#include <algorithm>
#include <cmath>

#include "modules/simulation/algorithm/world_geometry.h"

namespace runnel {

namespace {

void AddRing(const Ring& ring, double height, Outline& outline) {
  for (const Segment2& side : SidesOf(ring)) outline.flats.push_back({side, height});
}

void AddWall(const WallObstacle& wall, Outline& outline) {
  for (const Segment2& piece : PiecesOf(wall.points)) {
    AddRing(CornersOf(StraightPart(piece, wall.thickness, wall.height)), wall.height, outline);
  }
  for (const Point2 point : wall.points) {
    outline.rounds.push_back({point, wall.thickness / 2, wall.height});
  }
}

}  // namespace

Outline OutlineOf(const World& world, double bounds_height) {
  Outline outline;
  for (const PolygonObstacle& polygon : world.polygons) {
    AddRing(polygon.outline, polygon.height, outline);
    for (const Ring& hole : polygon.holes) AddRing(hole, polygon.height, outline);
  }
  for (const BoxObstacle& box : world.boxes) AddRing(CornersOf(box), box.height, outline);
  for (const CylinderObstacle& cylinder : world.cylinders) {
    outline.rounds.push_back({cylinder.centre, cylinder.radius, cylinder.height});
  }
  for (const WallObstacle& wall : world.walls) AddWall(wall, outline);
  if (world.bounds) AddRing(*world.bounds, bounds_height, outline);
  return outline;
}

void Extent::Include(Point2 point, double reach) {
  if (!std::isfinite(point.x) || !std::isfinite(point.y)) return;
  low = {std::min(low.x, point.x - reach), std::min(low.y, point.y - reach)};
  high = {std::max(high.x, point.x + reach), std::max(high.y, point.y + reach)};
}

Extent ExtentOf(const World& world) {
  Extent extent{Position(world.start), Position(world.start)};
  extent.Include(world.goal);
  const Outline outline = OutlineOf(world);
  for (const Outline::Flat& flat : outline.flats) extent.Include(flat.ground.from);
  for (const Outline::Round& round : outline.rounds) extent.Include(round.centre, round.radius);
  return extent;
}

BoxObstacle StraightPart(const Segment2& piece, double thickness, double height) {
  const Point2 along = piece.to - piece.from;
  const Point2 middle = piece.from + 0.5 * along;
  return {.pose = {middle.x, middle.y, Direction(along)},
          .length = Norm(along),
          .width = thickness,
          .height = height};
}

}  // namespace runnel

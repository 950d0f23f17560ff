#include "modules/simulation/algorithm/outline.h"

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

BoxObstacle StraightPart(const Segment2& piece, double thickness, double height) {
  const Point2 along = piece.to - piece.from;
  const Point2 middle = piece.from + 0.5 * along;
  return {.pose = {middle.x, middle.y, Direction(along)},
          .length = Norm(along),
          .width = thickness,
          .height = height};
}

}  // namespace runnel

#include "modules/simulation/algorithm/outline.h"

#include <algorithm>
#include <cmath>

#include "modules/simulation/algorithm/world_geometry.h"
#include "modules/types/algorithm/angle.h"

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

constexpr double kArcStep = kPi / 12;

// From one direction counter-clockwise by `turn` to another, both ends included.
void AddArc(Point2 centre, double radius, double from, double turn, Ring& ring) {
  const int steps = std::max(1, static_cast<int>(std::ceil(turn / kArcStep)));
  for (int i = 0; i <= steps; ++i) {
    ring.push_back(centre + radius * UnitVector(from + turn * i / steps));
  }
}

Ring CircleOf(const CylinderObstacle& cylinder) {
  Ring ring;
  AddArc(cylinder.centre, cylinder.radius, 0.0, 2 * kPi, ring);
  ring.pop_back();  // the first again
  return ring;
}

// The right-hand side of the way from `before` by `corner` to `after`, where it turns.
void AddCorner(Point2 before, Point2 corner, Point2 after, double radius, Ring& ring) {
  const double in = Direction(corner - before), out = Direction(after - corner);
  const double turn = WrapAngle(out - in);
  if (turn >= 0) return AddArc(corner, radius, in - kPi / 2, turn, ring);
  // The inner side of the bend: where the two sides meet, if they are long enough to.
  const double shortened = radius * std::tan(-turn / 2);
  if (shortened < std::min(Distance(before, corner), Distance(corner, after))) {
    const Point2 side = corner + radius * UnitVector(in - kPi / 2);
    ring.push_back(side - shortened * UnitVector(in));
    return;
  }
  ring.push_back(corner + radius * UnitVector(in - kPi / 2));
  ring.push_back(corner);
  ring.push_back(corner + radius * UnitVector(out - kPi / 2));
}

void AddOutline(Ring points, double height, WorldMap& map, bool is_hole = false) {
  if (points.size() >= 3) map.outlines.push_back({std::move(points), height, is_hole});
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
  return {.pose = {middle.x, middle.y, Direction(along)}, .length = Norm(along), .width = thickness, .height = height};
}

Ring LineRound(const WallObstacle& wall) {
  std::vector<Point2> points = wall.points;
  points.erase(std::unique(points.begin(), points.end()), points.end());
  const double radius = wall.thickness / 2;
  if (wall.points.size() < 2) return {};
  if (points.size() == 1) return CircleOf({.centre = points[0], .radius = radius});
  // There on one side and back on the other, with half a circle at each end.
  Ring ring;
  const std::size_t last = points.size() - 1;
  for (std::size_t i = 1; i < last; ++i) {
    AddCorner(points[i - 1], points[i], points[i + 1], radius, ring);
  }
  AddArc(points[last], radius, Direction(points[last] - points[last - 1]) - kPi / 2, kPi, ring);
  for (std::size_t i = last - 1; i > 0; --i) {
    AddCorner(points[i + 1], points[i], points[i - 1], radius, ring);
  }
  AddArc(points[0], radius, Direction(points[0] - points[1]) - kPi / 2, kPi, ring);
  return ring;
}

WorldMap MapOf(const World& world) {
  WorldMap map{world.name, world.start, world.goal, {}, {}};
  if (world.bounds) map.bounds = *world.bounds;
  // A hole is one in the obstacles before it, so polygons come first: others may stand in a hole.
  for (const PolygonObstacle& polygon : world.polygons) {
    AddOutline(polygon.outline, polygon.height, map);
    for (const Ring& hole : polygon.holes) AddOutline(hole, polygon.height, map, true);
  }
  for (const BoxObstacle& box : world.boxes) AddOutline(CornersOf(box), box.height, map);
  for (const CylinderObstacle& cylinder : world.cylinders) {
    AddOutline(CircleOf(cylinder), cylinder.height, map);
  }
  for (const WallObstacle& wall : world.walls) AddOutline(LineRound(wall), wall.height, map);
  return map;
}

}  // namespace runnel

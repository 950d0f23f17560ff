#include "modules/simulation/algorithm/world_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace runnel {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double DistanceToLine(const std::vector<Segment2>& pieces, Point2 point) {
  double nearest = kInfinity;
  for (const Segment2& piece : pieces) nearest = std::min(nearest, Distance(piece, point));
  return nearest;
}

template <typename Obstacles>
double LeastDistance(const Obstacles& obstacles, Point2 point) {
  double least = kInfinity;
  for (const auto& obstacle : obstacles) least = std::min(least, SignedDistance(obstacle, point));
  return least;
}

}  // namespace

Ring CornersOf(const BoxObstacle& box) {
  const double ahead = box.length / 2, left = box.width / 2;
  return {ToWorld(box.pose, {-ahead, -left}), ToWorld(box.pose, {ahead, -left}), ToWorld(box.pose, {ahead, left}),
          ToWorld(box.pose, {-ahead, left})};
}

std::vector<Segment2> SidesOf(const Ring& ring) {
  std::vector<Segment2> sides = PiecesOf(ring);
  if (!ring.empty()) sides.push_back({ring.back(), ring.front()});
  return sides;
}

std::vector<Segment2> PiecesOf(const std::vector<Point2>& line) {
  std::vector<Segment2> pieces;
  for (std::size_t i = 1; i < line.size(); ++i) pieces.push_back({line[i - 1], line[i]});
  return pieces;
}

bool Contains(const Ring& ring, Point2 point) {
  bool inside = false;  // changes at every side that a ray along x crosses
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point2 a = ring[i], b = ring[(i + 1) % ring.size()];
    if ((a.y > point.y) == (b.y > point.y)) continue;
    if (point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

double SignedDistance(const Ring& ring, Point2 point) {
  const double distance = DistanceToLine(SidesOf(ring), point);
  return Contains(ring, point) ? -distance : distance;
}

double SignedDistance(const PolygonObstacle& polygon, Point2 point) {
  double distance = SignedDistance(polygon.outline, point);
  for (const Ring& hole : polygon.holes) distance = std::max(distance, -SignedDistance(hole, point));
  return distance;
}

double SignedDistance(const BoxObstacle& box, Point2 point) {
  const Point2 local = ToBody(box.pose, point);
  const double ahead = std::abs(local.x) - box.length / 2;
  const double aside = std::abs(local.y) - box.width / 2;
  return std::hypot(std::max(ahead, 0.0), std::max(aside, 0.0)) + std::min(std::max(ahead, aside), 0.0);
}

double SignedDistance(const CylinderObstacle& cylinder, Point2 point) {
  return Distance(cylinder.centre, point) - cylinder.radius;
}

double SignedDistance(const WallObstacle& wall, Point2 point) {
  return DistanceToLine(PiecesOf(wall.points), point) - wall.thickness / 2;
}

double ClearanceAt(const World& world, Point2 point) {
  const double to_bounds = world.bounds ? -SignedDistance(*world.bounds, point) : kInfinity;
  return std::min({to_bounds, LeastDistance(world.polygons, point), LeastDistance(world.boxes, point),
                   LeastDistance(world.cylinders, point), LeastDistance(world.walls, point)});
}

}  // namespace runnel

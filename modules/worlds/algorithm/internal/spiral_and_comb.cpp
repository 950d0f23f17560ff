#include "modules/worlds/algorithm/internal/generated_worlds.h"

namespace runnel::internal {

namespace {

constexpr double kThickness = 0.2;  // m, of the spiral's wall

/// A quarter turn, or several, and perhaps a mirror first: exact, since no sine is needed.
class Turned {
 public:
  explicit Turned(Random& random) : is_mirrored_(random.Coin()), quarters_(random.Below(4)) {}

  Point2 operator()(Point2 point) const {
    if (is_mirrored_) point.y = -point.y;
    for (int i = 0; i < quarters_; ++i) point = {-point.y, point.x};
    return Rounded(point);
  }

 private:
  bool is_mirrored_;
  int quarters_;
};

/// The teeth of a comb stand on its back, which is below.
Ring CombOutline(const GeneratorOptions& options, Random& random, double& width) {
  constexpr double kBack = 0.4, kDepth = 3.0;  // m
  const int teeth = options.count > 0 ? options.count : 3 + random.Below(5);
  Ring upper;  // from left to right
  double x = 0.0;
  for (int i = 0; i < teeth; ++i) {
    if (i > 0) x += (options.gap + kRoundingMargin) * random.Between(1.0, 1.8);
    const double tip = random.Between(0.6, 3.0), thickness = random.Between(0.3, 0.6);
    if (i > 0) upper.push_back({x, -kDepth});
    upper.push_back({x, tip});
    x += thickness;
    upper.push_back({x, tip});
    if (i + 1 < teeth) upper.push_back({x, -kDepth});
  }
  width = x;
  Ring outline{{0.0, -kDepth - kBack}, {x, -kDepth - kBack}};
  outline.insert(outline.end(), upper.rbegin(), upper.rend());
  for (Point2& point : outline) point.x -= x / 2;
  return outline;
}

}  // namespace

World MakeSpiral(const GeneratorOptions& options, Random& random) {
  const int turns = options.count > 0 ? options.count : 2 + random.Below(2);
  const int sides = 4 * turns - 1 + random.Below(4);
  const double pitch = (options.gap + kRoundingMargin) * random.Between(1.0, 1.6) + kThickness +
                       (options.is_enclosed ? 2.5 * options.gap + 0.1 : 0.0);
  const Turned turned(random);
  World world;
  WallObstacle wall{.points = {}, .thickness = kThickness};
  Point2 corner{pitch / 2, pitch / 2}, along{-pitch, 0.0};
  wall.points.push_back(turned(corner));
  for (int side = 0; side < sides; ++side) {
    const int pitches = side / 2 + 1;  // two sides of each length
    corner = corner + static_cast<double>(pitches) * along;
    along = {-along.y, along.x};
    wall.points.push_back(turned(corner));
  }
  world.walls.push_back(std::move(wall));
  const int windings = sides / 4;
  const double reach = (windings + 1.5) * pitch + 1.5;
  const Point2 start = turned({-reach, random.Between(-0.4, 0.4) * pitch});
  world.start = {start.x, start.y, 0.0};
  return world;
}

World MakeComb(const GeneratorOptions& options, Random& random) {
  double width = 0.0;
  const Ring outline = CombOutline(options, random, width);
  const Turned turned(random);
  World world;
  PolygonObstacle comb;
  for (const Point2 point : outline) comb.outline.push_back(turned(point));
  world.polygons.push_back(std::move(comb));
  const double away = width / 2 + 2.0 * options.gap;
  const Point2 start = turned({-away, random.Between(-0.5, 0.5)});
  world.start = {start.x, start.y, 0.0};
  world.goal = turned({away, random.Between(-0.5, 0.5)});
  return world;
}

}  // namespace runnel::internal

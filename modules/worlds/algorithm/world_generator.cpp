#include "modules/worlds/algorithm/world_generator.h"

#include <cmath>

#include <fmt/format.h>

#include "modules/worlds/algorithm/internal/generated_worlds.h"

namespace runnel {

namespace {

using internal::Rounded;

constexpr double kEnclosureThickness = 0.1;  // m

std::string OutOfRange(const char* what, double value, double low, double high) {
  return fmt::format("the {} must be between {:g} and {:g}, not {:g}", what, low, high, value);
}

bool IsWithin(double value, double low, double high) { return value >= low && value <= high; }

/// An eight-sided wall that keeps a robot out, with room for it inside.
WallObstacle Enclosure(Point2 goal, double gap) {
  WallObstacle wall{.points = {}, .thickness = kEnclosureThickness};
  for (int i = 0; i <= 8; ++i) {
    wall.points.push_back(Rounded(goal + 0.75 * gap * UnitVector(kPi / 8 + i % 8 * kPi / 4)));
  }
  return wall;
}

}  // namespace

std::string FaultOf(const GeneratorOptions& options) {
  const double least = std::max(kLeastGround, 5.0 * options.gap);
  if (!IsWithin(options.gap, kLeastGap, kGreatestGap)) {
    return OutOfRange("gap", options.gap, kLeastGap, kGreatestGap);
  }
  if (!IsWithin(options.width, least, kGreatestGround)) {
    return OutOfRange("width", options.width, least, kGreatestGround);
  }
  if (!IsWithin(options.height, least, kGreatestGround)) {
    return OutOfRange("height", options.height, least, kGreatestGround);
  }
  if (!IsWithin(options.count, 0, kGreatestCount)) {
    return OutOfRange("count", options.count, 0, kGreatestCount);
  }
  return {};
}

World GenerateWorld(const GeneratorOptions& options) {
  Random random(options.seed);
  World world;
  switch (options.kind) {
    case WorldKind::kScatter:
      world = internal::MakeScatter(options, random);
      break;
    case WorldKind::kMaze:
      world = internal::MakeMaze(options, random);
      break;
    case WorldKind::kSpiral:
      world = internal::MakeSpiral(options, random);
      break;
    case WorldKind::kComb:
      world = internal::MakeComb(options, random);
      break;
  }
  // A maze has walls enough: there, the goal's cell has no door.
  const bool needs_wall = options.is_enclosed && options.kind != WorldKind::kMaze;
  if (needs_wall) world.walls.push_back(Enclosure(world.goal, options.gap));
  return world;
}

}  // namespace runnel

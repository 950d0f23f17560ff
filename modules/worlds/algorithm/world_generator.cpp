#include "modules/worlds/algorithm/world_generator.h"

#include <fmt/format.h>

#include "modules/worlds/algorithm/internal/generated_worlds.h"

namespace runnel {

namespace {

constexpr double kEnclosureThickness = 0.1;  // m

// By kind.
constexpr std::array kMakers{internal::MakeScatter, internal::MakeMaze, internal::MakeSpiral, internal::MakeComb,
                             internal::MakeRing};

struct Range {
  const char* what;
  double value, low, high;
};

/// An eight-sided wall that keeps a robot out, with room for it inside.
WallObstacle Enclosure(Point2 goal, double gap) {
  WallObstacle wall{.points = {}, .thickness = kEnclosureThickness};
  for (int i = 0; i <= 8; ++i) {
    wall.points.push_back(internal::Rounded(goal + 0.75 * gap * UnitVector(kPi / 8 + i % 8 * kPi / 4)));
  }
  return wall;
}

}  // namespace

std::string FaultOf(const GeneratorOptions& options) {
  const double least = std::max(kLeastGround, 5.0 * options.gap);
  const bool has_height = options.kind == WorldKind::kScatter || options.kind == WorldKind::kMaze;
  const bool has_width = has_height || options.kind == WorldKind::kRing;
  for (const auto& [what, value, low, high] : {Range{"gap", options.gap, kLeastGap, kGreatestGap},
                                               Range{"width", options.width, has_width ? least : 0, kGreatestGround},
                                               Range{"height", options.height, has_height ? least : 0, kGreatestGround},
                                               Range{"count", static_cast<double>(options.count), 0, kGreatestCount}}) {
    if (value >= low && value <= high) continue;  // never so for what is no number
    return fmt::format("the {} must be between {:g} and {:g}, not {:g}", what, low, high, value);
  }
  return {};
}

World GenerateWorld(const GeneratorOptions& options) {
  Random random(options.seed);
  const auto kind = static_cast<std::size_t>(options.kind);
  World world = kMakers[kind](options, random);
  world.name = fmt::format("{}_{}", kWorldKindNames[kind], options.seed);
  // A maze has walls enough: there, the goal's cell has no door.
  const bool needs_wall = options.is_enclosed && options.kind != WorldKind::kMaze;
  if (needs_wall) world.walls.push_back(Enclosure(world.goal, options.gap));
  return world;
}

}  // namespace runnel

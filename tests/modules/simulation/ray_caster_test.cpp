#include "modules/simulation/algorithm/ray_caster.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/simulation/algorithm/random.h"
#include "modules/simulation/algorithm/world_geometry.h"
#include "modules/types/algorithm/angle.h"
#include "tests/modules/simulation/rays.h"

namespace runnel {
namespace {

TEST(RayCaster, SeesNothingInAnEmptyWorld) { EXPECT_EQ(Rays(World{}).Cast({0, 0}, 1.0, 100.0), kInfinity); }

TEST(RayCaster, MeasuresABoxAtItsFacesAndCorners) {
  const RayCaster rays = Rays({.boxes = {{.pose = {3, 1, 0}, .length = 2, .width = 4}}});
  EXPECT_NEAR(rays.Cast({0, 0}, 0.0, 10.0), 2.0, 1e-12);
  EXPECT_NEAR(rays.Cast({0, 0}, 0.3, 10.0), 2.0 / std::cos(0.3), 1e-12);
  EXPECT_NEAR(rays.Cast({0, 3}, 0.0, 10.0), 2.0, 1e-9);
  EXPECT_EQ(rays.Cast({0, 3.001}, 0.0, 10.0), kInfinity);
  EXPECT_NEAR(rays.Cast({3, 5}, -kPi / 2, 10.0), 2.0, 1e-12);
  EXPECT_NEAR(rays.Cast({6, 1}, kPi, 10.0), 2.0, 1e-12);
  EXPECT_EQ(rays.Cast({0, 0}, kPi, 10.0), kInfinity);
}

TEST(RayCaster, MeasuresATurnedBox) {
  const RayCaster rays = Rays({.boxes = {{.pose = {3, 0, kPi / 4}, .length = std::sqrt(2), .width = std::sqrt(2)}}});
  EXPECT_NEAR(rays.Cast({0, 0}, 0.0, 10.0), 2.0, 1e-12);
  EXPECT_NEAR(rays.Cast({0, 0.5}, 0.0, 10.0), 2.5, 1e-12);
}

TEST(RayCaster, MeasuresACylinderFromOutsideAndInside) {
  const RayCaster rays = Rays({.cylinders = {{.centre = {3, 0}, .radius = 1}}});
  EXPECT_NEAR(rays.Cast({0, 0}, 0.0, 10.0), 2.0, 1e-12);
  EXPECT_NEAR(rays.Cast({0, 0.6}, 0.0, 10.0), 3.0 - 0.8, 1e-12);
  EXPECT_EQ(rays.Cast({0, 1.001}, 0.0, 10.0), kInfinity);
  EXPECT_NEAR(rays.Cast({3, 0}, 1.0, 10.0), 1.0, 1e-12);
  EXPECT_EQ(rays.Cast({5, 0}, 0.0, 10.0), kInfinity);
}

TEST(RayCaster, SeesARoomFromWithinTheHoleOfAPolygon) {
  const RayCaster rays = Rays({.polygons = {{.outline = {{-5, -5}, {5, -5}, {5, 5}, {-5, 5}},
                                             .holes = {{{-2, -3}, {-2, 3}, {4, 3}, {4, -3}}}}}});
  EXPECT_NEAR(rays.Cast({0, 0}, 0.0, 10.0), 4.0, 1e-12);
  EXPECT_NEAR(rays.Cast({0, 0}, kPi / 2, 10.0), 3.0, 1e-12);
  EXPECT_NEAR(rays.Cast({0, 0}, kPi, 10.0), 2.0, 1e-12);
  EXPECT_NEAR(rays.Cast({-7, 0}, 0.0, 10.0), 2.0, 1e-12);
}

TEST(RayCaster, MeasuresAThinWallWithRoundEnds) {
  const RayCaster rays = Rays({.walls = {{.points = {{2, -1}, {2, 1}, {4, 1}}, .thickness = 0.02}}});
  EXPECT_NEAR(rays.Cast({0, 0}, 0.0, 10.0), 1.99, 1e-12);
  EXPECT_NEAR(rays.Cast({3, 0}, kPi, 10.0), 0.99, 1e-12);
  EXPECT_NEAR(rays.Cast({2, -3}, kPi / 2, 10.0), 1.99, 1e-12);
  EXPECT_NEAR(rays.Cast({0, 1}, 0.0, 10.0), 1.99, 1e-12);
  EXPECT_NEAR(rays.Cast({6, 1}, kPi, 10.0), 1.99, 1e-12);
}

TEST(RayCaster, SeesNoFurtherThanItsRange) {
  const RayCaster rays = Rays({.cylinders = {{.centre = {3, 0}, .radius = 1}}});
  EXPECT_EQ(rays.Cast({0, 0}, 0.0, 1.999), kInfinity);
  EXPECT_NEAR(rays.Cast({0, 0}, 0.0, 2.001), 2.0, 1e-12);
}

TEST(RayCaster, LooksOverWhatIsLowerThanItsEye) {
  const RayCaster rays = Rays({.boxes = {{.pose = {2, 0, 0}, .length = 1, .width = 1, .height = 0.1},
                                         {.pose = {5, 0, 0}, .length = 1, .width = 1}}});
  EXPECT_NEAR(rays.Cast({0, 0}, 0.0, 10.0), 4.5, 1e-12);
}

TEST(RayCaster, SeesTheBoundsFromWithinAndFromFarOutside) {
  const RayCaster rays = Rays({.bounds = Ring{{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}});
  EXPECT_NEAR(rays.Cast({0, 0}, kPi / 4, 10.0), 4 * std::sqrt(2), 1e-9);
  EXPECT_NEAR(rays.Cast({-1000, 0}, 0.0, 2000.0), 996.0, 1e-9);
}

TEST(RayCaster, AnOriginThatIsNoNumberSeesNothing) {
  const RayCaster rays = Rays({.bounds = Ring{{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}});
  EXPECT_EQ(rays.Cast({std::nan(""), 0}, 0.0, 10.0), kInfinity);
  EXPECT_EQ(rays.Cast({0, 0}, std::nan(""), 10.0), kInfinity);
}

World RandomWorld(GaussianNoise& noise) {
  World world;
  for (int i = 0; i < 15; ++i) {
    const Point2 place = {noise(3.0), noise(3.0)};
    const double size = 0.05 + std::abs(noise(0.4));
    world.cylinders.push_back({.centre = place, .radius = size});
    world.boxes.push_back({.pose = {noise(3.0), noise(3.0), noise(2.0)}, .length = size, .width = 0.3});
    world.walls.push_back({.points = {place, {noise(3.0), noise(3.0)}}, .thickness = 0.05});
  }
  return world;
}

/// Without a grid, by walking from point to point as far as nothing can be hit.
double WalkTo(const World& world, Point2 origin, double direction, double range) {
  double distance = 0.0;
  for (int i = 0; i < 100000 && distance < range; ++i) {
    const double free = ClearanceAt(world, origin + distance * UnitVector(direction));
    if (free < 1e-9) return distance;
    distance += free;
  }
  return kInfinity;
}

TEST(RayCaster, AgreesWithWalkingThroughRandomWorlds) {
  GaussianNoise noise(7);
  int hits = 0;
  for (int i = 0; i < 20; ++i) {
    const World world = RandomWorld(noise);
    const RayCaster rays = Rays(world);
    for (int ray = 0; ray < 200; ++ray) {
      const Point2 origin = {noise(4.0), noise(4.0)};
      const double direction = noise(3.0);
      if (ClearanceAt(world, origin) < 1e-3) continue;
      const double expected = WalkTo(world, origin, direction, 6.0);
      const double found = rays.Cast(origin, direction, 6.0);
      if (std::isfinite(expected)) {
        EXPECT_NEAR(found, expected, 1e-3);  // grazing walks end a little early
        ++hits;
      } else {
        EXPECT_EQ(found, kInfinity);
      }
    }
  }
  EXPECT_GT(hits, 1000);
}

TEST(RayCaster, NoRaySlipsThroughTheCornersOfARing) {
  Ring ring;
  for (int i = 0; i < 360; ++i) ring.push_back(3.0 * UnitVector(DegreesToRadians(i)));
  const RayCaster rays = Rays({.bounds = ring});
  std::vector<Point2> directions;
  for (int i = 0; i < 3600; ++i) directions.push_back(UnitVector(DegreesToRadians(0.1 * i)));
  std::vector<float> distances(directions.size());
  rays.CastFan({0, 0}, UnitVector(0.0), directions, 10.0, distances);
  EXPECT_THAT(distances, testing::Each(testing::AllOf(testing::Ge(2.999F), testing::Le(3.001F))));
}

}  // namespace
}  // namespace runnel

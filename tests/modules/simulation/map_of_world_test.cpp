#include <cmath>

#include <gtest/gtest.h>

#include "modules/simulation/algorithm/outline.h"
#include "modules/simulation/algorithm/random.h"
#include "modules/simulation/algorithm/world_geometry.h"

namespace runnel {
namespace {

// How often a closed line goes round a point, counter-clockwise.
int WindingNumber(const Ring& ring, Point2 point) {
  double angle = 0;
  for (const Segment2& side : SidesOf(ring)) {
    const Point2 from = side.from - point, to = side.to - point;
    angle += std::atan2(Cross(from, to), Dot(from, to));
  }
  return static_cast<int>(std::lround(angle / (2 * std::acos(-1.0))));
}

// The line round a wall must agree with the distance from the wall, but for the little that arcs
// made of straight lines leave out.
void ExpectRoundedBy(const WallObstacle& wall, double leeway) {
  const Ring ring = LineRound(wall);
  ASSERT_GE(ring.size(), 3u);
  for (double x = -3; x <= 6; x += 0.0837) {
    for (double y = -3; y <= 6; y += 0.0791) {
      const double distance = SignedDistance(wall, {x, y});
      if (std::abs(distance) < leeway) continue;
      ASSERT_EQ(WindingNumber(ring, {x, y}) != 0, distance < 0) << x << ", " << y;
    }
  }
}

TEST(LineRoundAWall, HoldsExactlyTheWall) {
  ExpectRoundedBy({.points = {{0, 0}, {3, 0}}, .thickness = 0.4}, 0.005);
  ExpectRoundedBy({.points = {{0, 0}, {3, 0}, {3, 3}}, .thickness = 0.4}, 0.005);
  ExpectRoundedBy({.points = {{0, 0}, {3, 0}, {0.5, 1}, {3, 4}}, .thickness = 0.6}, 0.01);
  ExpectRoundedBy({.points = {{1, 1}, {1, 1}}, .thickness = 1}, 0.01);
  ExpectRoundedBy({.points = {{1, 1}, {1, 1}, {2, 2}, {2, 2}}, .thickness = 0.2}, 0.005);
  ExpectRoundedBy({.points = {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}}, .thickness = 0.3}, 0.005);
  // Pieces shorter than the wall is thick, and straight back where it came from.
  ExpectRoundedBy({.points = {{0, 0}, {1, 0}, {1.1, 0.2}, {2, 1}}, .thickness = 0.8}, 0.02);
  ExpectRoundedBy({.points = {{0, 0}, {2, 0}, {1, 0}}, .thickness = 0.4}, 0.005);
}

TEST(LineRoundAWall, HoldsExactlyTheWallWhicheverWayItBends) {
  Random random(4);
  for (int i = 0; i < 20; ++i) {
    WallObstacle wall{.points = {}, .thickness = random.Between(0.1, 0.4)};
    for (int point = 0; point < 5; ++point) {
      wall.points.push_back({random.Between(0, 4), random.Between(0, 4)});
    }
    ExpectRoundedBy(wall, 0.01);
  }
}

TEST(MapOfAWorld, HasEverythingThatStandsThere) {
  World world{.name = "all", .start = {1, 2, 3}, .goal = {4, 5}};
  world.boxes.push_back({.pose = {2, 0, 0}, .length = 1, .width = 4, .height = 0.3});
  world.cylinders.push_back({.centre = {7, 7}, .radius = 1});
  world.walls.push_back({.points = {{0, 0}, {1, 0}}, .thickness = 0.1});
  world.polygons.push_back({.outline = {{0, 0}, {9, 0}, {9, 9}, {0, 9}}, .holes = {{{1, 1}, {2, 1}, {2, 2}}}});
  world.bounds = Ring{{-9, -9}, {9, -9}, {0, 9}};
  const WorldMap map = MapOf(world);
  EXPECT_EQ(map.name, "all");
  EXPECT_EQ(map.start, (Pose2{1, 2, 3}));
  EXPECT_EQ(map.goal, (Point2{4, 5}));
  EXPECT_EQ(map.bounds, *world.bounds);
  ASSERT_EQ(map.outlines.size(), 5u);
  EXPECT_EQ(map.outlines[0].points, world.polygons[0].outline);
  EXPECT_FALSE(map.outlines[0].is_hole);
  EXPECT_EQ(map.outlines[1].points, world.polygons[0].holes[0]);
  EXPECT_TRUE(map.outlines[1].is_hole);
  EXPECT_EQ(map.outlines[2].points, CornersOf(world.boxes[0]));
  EXPECT_EQ(map.outlines[2].height, 0.3);
  for (const Point2 point : map.outlines[3].points) {
    EXPECT_NEAR(Distance(point, {7, 7}), 1, 1e-12);
  }
  EXPECT_GE(map.outlines[3].points.size(), 20u);
  EXPECT_EQ(map.outlines[4].points, LineRound(world.walls[0]));
}

}  // namespace
}  // namespace runnel

#include "modules/worlds/algorithm/shortest_path.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/simulation/algorithm/world_geometry.h"
#include "modules/types/algorithm/angle.h"
#include "modules/worlds/algorithm/world_generator.h"

namespace runnel {
namespace {

constexpr double kRadius = 0.35;

double LengthBetween(const World& world, Point2 from, Point2 to, double radius = kRadius) {
  const auto path = FindShortestPath(ConfigurationSpace(world, radius), from, to);
  return path ? path->length : std::numeric_limits<double>::infinity();
}

World WithBox(double length, double width) {
  World world;
  world.boxes.push_back({.length = length, .width = width});
  return world;
}

TEST(ShortestPath, IsTheStraightLineWhereNothingIsInTheWay) {
  EXPECT_DOUBLE_EQ(LengthBetween(World{}, {0, 0}, {3, 4}), 5.0);
  EXPECT_DOUBLE_EQ(LengthBetween(WithBox(2, 2), {-5, 1.36}, {5, 1.36}), 10.0);
  EXPECT_DOUBLE_EQ(LengthBetween(World{}, {1, 1}, {1, 1}), 0.0);
}

TEST(ShortestPath, WrapsRoundACylinder) {
  World world;
  world.cylinders.push_back({.centre = {0, 0}, .radius = 1.0});
  const double radius = 1.0 + kRadius, away = 4.0;
  const double tangent = std::sqrt(away * away - radius * radius);
  const double arc = kPi - 2 * std::acos(radius / away);
  EXPECT_NEAR(LengthBetween(world, {-away, 0}, {away, 0}), 2 * tangent + radius * arc, 1e-12);
}

TEST(ShortestPath, RoundsTwoCornersOfABox) {
  // From the middle before a box to the middle behind it: two tangents, two eighth of a circle or
  // so, and the side of the box between.
  const double half = 1.0, away = 5.0;
  const Point2 corner{half, half}, start{-away, 0};
  const Point2 gap = start - Point2{-corner.x, corner.y};
  const double tangent = std::sqrt(Dot(gap, gap) - kRadius * kRadius);
  // The direction from the corner to where the tangent touches it, against straight up.
  const double touch = Direction(gap) + 2 * kPi - std::acos(kRadius / Norm(gap));
  const double arc = kRadius * std::abs(touch - kPi / 2);
  EXPECT_NEAR(LengthBetween(WithBox(2, 2), start, {away, 0}), 2 * (tangent + arc) + 2 * half, 1e-12);
}

TEST(ShortestPath, GoesThroughAGapIfTheRobotFits) {
  World world;
  world.boxes.push_back({.pose = {0, 5.35}, .length = 1, .width = 10});
  world.boxes.push_back({.pose = {0, -5.35}, .length = 1, .width = 10});
  EXPECT_NEAR(LengthBetween(world, {-3, 0}, {3, 0}), 6.0, 1e-12);  // 0.7 m wide, touching both
  EXPECT_GT(LengthBetween(world, {-3, 0}, {3, 0}, 0.36), 20.0);
}

TEST(ShortestPath, IsNotThereWhereTheGoalIsWalledInOrInsideOrOutside) {
  World walled;
  walled.walls.push_back({.points = {{1, 1}, {3, 1}, {3, -1}, {1, -1}, {1, 1}}, .thickness = 0.1});
  EXPECT_EQ(FindShortestPath(ConfigurationSpace(walled, kRadius), {-5, 0}, {2, 0}), std::nullopt);
  EXPECT_EQ(FindShortestPath(ConfigurationSpace(WithBox(4, 4), kRadius), {-5, 0}, {0, 0}), std::nullopt);
  World bounded;
  bounded.bounds = Ring{{-2, -2}, {2, -2}, {2, 2}, {-2, 2}};
  EXPECT_EQ(FindShortestPath(ConfigurationSpace(bounded, kRadius), {0, 0}, {5, 0}), std::nullopt);
}

TEST(ShortestPath, MovesAnEndThatIsTooNearToAWallWithinReach) {
  const ConfigurationSpace space(WithBox(2, 4), kRadius);
  EXPECT_EQ(FindShortestPath(space, {-5, 0}, {-1.3, 0}), std::nullopt);
  const auto path = FindShortestPath(space, {-5, 0}, {-1.3, 0}, 0.1);
  ASSERT_TRUE(path);
  EXPECT_NEAR(path->length, 5 - 1.35, 1e-9);
  EXPECT_EQ(FindShortestPath(space, {-5, 0}, {-1.2, 0}, 0.1), std::nullopt);
}

TEST(ShortestPath, IsAsLongAsItsLine) {
  const World world = GenerateWorld({.kind = WorldKind::kScatter, .seed = 5});
  const auto path = FindShortestPath(ConfigurationSpace(world, kRadius), Position(world.start), world.goal);
  ASSERT_TRUE(path);
  double length = 0.0;
  for (std::size_t i = 1; i < path->points.size(); ++i) {
    length += Distance(path->points[i - 1], path->points[i]);
    EXPECT_GT(ClearanceAt(world, path->points[i]), kRadius - 1e-6);
  }
  EXPECT_EQ(path->points.front(), Position(world.start));
  EXPECT_EQ(path->points.back(), world.goal);
  EXPECT_LE(length, path->length + 1e-9);
  EXPECT_GT(length, 0.999 * path->length);
}

// Another way to the same: points strewn round all that sticks out, joined where many samples
// between them are clear of the obstacles. Longer than the shortest path, but not by much.
class SampledGraph {
 public:
  SampledGraph(const World& world, Point2 from, Point2 to) : world_(world), places_{from, to} {
    const Outline outline = OutlineOf(world);
    for (const Outline::Round& round : outline.rounds) Strew(round.centre, round.radius);
    for (const Outline::Flat& flat : outline.flats) Strew(flat.ground.from, 0.0);
  }

  double Length() const {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    std::vector<double> length(places_.size(), kFar);
    std::vector<bool> is_done(places_.size());
    length[0] = 0.0;
    for (;;) {
      std::size_t next = places_.size();
      for (std::size_t i = 0; i < places_.size(); ++i) {
        if (!is_done[i] && length[i] < kFar && (next == places_.size() || length[i] < length[next])) next = i;
      }
      if (next == places_.size() || next == 1) return length[1];
      is_done[next] = true;
      for (std::size_t i = 0; i < places_.size(); ++i) {
        const double through = length[next] + Distance(places_[next], places_[i]);
        if (through < length[i] && IsClear(places_[next], places_[i])) length[i] = through;
      }
    }
  }

 private:
  static constexpr int kDirections = 24;
  // A chord between neighbours stays outside of the circle.
  static constexpr double kStretch = 1.0 / 0.9914;  // of 1 / cos(π / 24)

  void Strew(Point2 centre, double radius) {
    for (int i = 0; i < kDirections; ++i) {
      const Point2 place = centre + kStretch * (radius + kRadius) * UnitVector(2 * kPi * i / kDirections);
      if (ClearanceAt(world_, place) >= kRadius - 1e-9) places_.push_back(place);
    }
  }
  bool IsClear(Point2 from, Point2 to) const {
    const int steps = 2 + static_cast<int>(Distance(from, to) / 0.05);
    for (int i = 0; i <= steps; ++i) {
      if (ClearanceAt(world_, from + (1.0 * i / steps) * (to - from)) < kRadius - 1e-3) return false;
    }
    return true;
  }

  const World& world_;
  std::vector<Point2> places_;
};

struct Sampled {
  WorldKind kind;
  int count;
};
class ShortestPathInRandomWorlds : public testing::TestWithParam<Sampled> {};

TEST_P(ShortestPathInRandomWorlds, IsALittleShorterThanASampledOne) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const World world =
        GenerateWorld({.kind = GetParam().kind, .seed = seed, .width = 9, .height = 8, .count = GetParam().count});
    const double sampled = SampledGraph(world, Position(world.start), world.goal).Length();
    const double exact = LengthBetween(world, Position(world.start), world.goal);
    EXPECT_LE(exact, sampled + 0.01) << world.name;
    EXPECT_GT(exact, 0.97 * sampled - 0.01) << world.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, ShortestPathInRandomWorlds,
                         testing::Values(Sampled{WorldKind::kScatter, 6}, Sampled{WorldKind::kMaze, 0},
                                         Sampled{WorldKind::kSpiral, 1}, Sampled{WorldKind::kComb, 3}));

double Perimeter(const World& world) {
  double length = 0.0;
  for (const BoundaryLoop& loop : ConfigurationSpace(world, kRadius).Boundaries()) {
    length += LengthOf(loop);
  }
  return length;
}

std::size_t LoopCount(const World& world) { return ConfigurationSpace(world, kRadius).Boundaries().size(); }

TEST(Boundaries, AreAsLongAsTheGrownObstacles) {
  EXPECT_NEAR(Perimeter(WithBox(2, 3)), 10 + 2 * kPi * kRadius, 1e-6);
  World world;
  world.cylinders.push_back({.centre = {1, 2}, .radius = 0.5});
  EXPECT_NEAR(Perimeter(world), 2 * kPi * (0.5 + kRadius), 1e-9);
  World wall;
  wall.walls.push_back({.points = {{0, 0}, {4, 0}}, .thickness = 0.2});
  EXPECT_NEAR(Perimeter(wall), 8 + 2 * kPi * (0.1 + kRadius), 1e-6);
  World bounds;
  bounds.bounds = Ring{{0, 0}, {4, 0}, {4, 3}, {0, 3}};
  EXPECT_NEAR(Perimeter(bounds), 14 - 8 * kRadius, 1e-6);
}

TEST(Boundaries, OfObstaclesTooNearForTheRobotAreOne) {
  World world;
  world.boxes.push_back({.pose = {0, 0}, .length = 2, .width = 2});
  world.boxes.push_back({.pose = {2.5, 0}, .length = 2, .width = 2});
  EXPECT_EQ(LoopCount(world), 1u);
  world.boxes.back().pose.x = 2.8;
  EXPECT_EQ(LoopCount(world), 2u);
  world.boxes.back().pose.x = 2.0;  // side by side: one box of 4 m
  EXPECT_EQ(LoopCount(world), 1u);
  EXPECT_NEAR(Perimeter(world), 12 + 2 * kPi * kRadius, 1e-6);
}

TEST(Boundaries, AreOneInsideAndOneOutsideOfARing) {
  World world;
  world.walls.push_back({.points = {{1, 1}, {5, 1}, {5, 5}, {1, 5}, {1, 1}}, .thickness = 0.2});
  EXPECT_EQ(LoopCount(world), 2u);
  EXPECT_NEAR(Perimeter(world), 16 + 2 * kPi * (0.1 + kRadius) + 16 - 8 * (0.1 + kRadius), 1e-6);
}

TEST(Boundaries, AreClosedInRandomWorlds) {
  for (const WorldKind kind :
       {WorldKind::kScatter, WorldKind::kMaze, WorldKind::kSpiral, WorldKind::kComb, WorldKind::kRing}) {
    for (std::uint64_t seed = 1; seed <= 25; ++seed) {
      const World world = GenerateWorld({.kind = kind, .seed = seed});
      const ConfigurationSpace space(world, kRadius);
      const auto loops = space.Boundaries();
      EXPECT_FALSE(loops.empty());
      for (const BoundaryLoop& loop : loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
          const Point2 next = loop[(i + 1) % loop.size()].from;
          EXPECT_LT(Distance(loop[i].to, next), 1e-4) << world.name;
          // The free space is on the right.
          if (!loop[i].centre && loop[i].length() > 0.01) {
            const Point2 along = (1 / loop[i].length()) * (loop[i].to - loop[i].from);
            const Point2 middle = 0.5 * (loop[i].from + loop[i].to);
            EXPECT_GT(ClearanceAt(world, middle + 1e-3 * Point2{along.y, -along.x}), kRadius);
          }
        }
      }
    }
  }
}

TEST(Boundaries, AreCrossedTwiceByALineThrough) {
  const auto loops = ConfigurationSpace(WithBox(2, 2), kRadius).Boundaries();
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_EQ(Crossings(loops.front(), {{-5, 0.2}, {5, 0.3}}), 2);
  EXPECT_EQ(Crossings(loops.front(), {{-5, 1.1}, {0, 2.5}}), 0);
  EXPECT_EQ(Crossings(loops.front(), {{-5, 0}, {0, 0}}), 1);
  // Through the joints of straight pieces and arcs, and along a straight one.
  for (const BoundaryPiece& piece : loops.front()) {
    for (const Point2 way : {Point2{1, 0}, Point2{0, 1}, Point2{1, 1}, Point2{1, -2}}) {
      EXPECT_EQ(Crossings(loops.front(), {piece.from - 20 * way, piece.from + 20 * way}) % 2, 0);
    }
  }
  EXPECT_NEAR(DistanceTo(loops.front(), {-5, 0}), 3.65, 1e-9);
  EXPECT_NEAR(DistanceTo(loops.front(), {-4, 5}), std::hypot(3, 4) - kRadius, 1e-9);
}

TEST(Boundaries, OfACylinderAreCrossedTwiceByALineThroughItsCentreOrBeside) {
  World world;
  world.cylinders.push_back({.centre = {0, 0}, .radius = 1.0});
  const auto loops = ConfigurationSpace(world, kRadius).Boundaries();
  ASSERT_EQ(loops.size(), 1u);
  for (int degrees = 0; degrees < 360; degrees += 15) {
    const Point2 way = UnitVector(degrees * kPi / 180), side{-way.y, way.x};
    for (const double by : {0.0, 1e-12, -1e-12, 0.01, -0.01, 1.3, -1.3}) {
      const Point2 middle = by * side;
      EXPECT_EQ(Crossings(loops.front(), {middle - 5 * way, middle + 5 * way}), 2) << degrees << " " << by;
      EXPECT_EQ(Crossings(loops.front(), {middle - 5 * way, middle}), 1) << degrees << " " << by;
      EXPECT_EQ(Crossings(loops.front(), {middle, middle + 5 * way}), 1) << degrees << " " << by;
      EXPECT_EQ(Crossings(loops.front(), {middle - 5 * way, middle - 2 * way}), 0) << degrees << " " << by;
    }
    EXPECT_EQ(Crossings(loops.front(), {1.4 * side - 5 * way, 1.4 * side + 5 * way}), 0);
  }
}

}  // namespace
}  // namespace runnel

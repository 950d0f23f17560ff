#include "modules/worlds/algorithm/world_generator.h"

#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/simulation/algorithm/world_checks.h"
#include "modules/simulation/algorithm/world_geometry.h"
#include "modules/worlds/algorithm/shortest_path.h"

namespace runnel {
namespace {

constexpr std::uint64_t kSeeds = 300;
// Half of the least gap: who fits there fits everywhere. Less a millimetre, since arcs of the
// boundaries of neighbours touch.
constexpr double kHalfGap = 0.499;

std::vector<std::string> MessagesOf(const std::vector<WorldFault>& faults) {
  std::vector<std::string> messages;
  for (const WorldFault& fault : faults) messages.push_back(fault.message);
  return messages;
}

bool IsWholeMillimetre(double length) { return std::abs(length * 1000 - std::round(length * 1000)) < 1e-6; }

class GeneratedWorlds : public testing::TestWithParam<WorldKind> {
 protected:
  World Make(std::uint64_t seed, bool is_enclosed = false) {
    return GenerateWorld({.kind = GetParam(), .seed = seed, .is_enclosed = is_enclosed});
  }
};

TEST_P(GeneratedWorlds, HaveNoFaultsAndRoomAtTheEnds) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    for (const bool is_enclosed : {false, true}) {
      const World world = Make(seed, is_enclosed);
      EXPECT_THAT(MessagesOf(FaultsOf(world)), testing::IsEmpty()) << world.name;
      EXPECT_GE(ClearanceAt(world, Position(world.start)), 0.5) << world.name;
      EXPECT_GE(ClearanceAt(world, world.goal), 0.499) << world.name;
    }
  }
}

TEST_P(GeneratedWorlds, RepeatForTheSameSeedAndDifferForAnother) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    EXPECT_EQ(Make(seed), Make(seed));
    World other = Make(seed + 1);
    other.name = Make(seed).name;
    EXPECT_NE(Make(seed), other) << seed;
  }
}

TEST_P(GeneratedWorlds, LetTheRobotToTheGoalUnlessItIsEnclosed) {
  for (std::uint64_t seed = 0; seed < 15; ++seed) {
    for (const bool is_enclosed : {false, true}) {
      const World world = Make(seed, is_enclosed);
      const ConfigurationSpace space(world, kHalfGap);
      const auto path = FindShortestPath(space, Position(world.start), world.goal);
      EXPECT_EQ(path.has_value(), !is_enclosed) << world.name;
    }
  }
}

TEST_P(GeneratedWorlds, HaveCoordinatesThatCanBeRead) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const World world = Make(seed);
    EXPECT_TRUE(IsWholeMillimetre(world.start.x) && IsWholeMillimetre(world.start.y));
    for (const PolygonObstacle& polygon : world.polygons) {
      for (const Point2 point : polygon.outline) {
        EXPECT_TRUE(IsWholeMillimetre(point.x) && IsWholeMillimetre(point.y)) << world.name;
      }
    }
    for (const WallObstacle& wall : world.walls) {
      for (const Point2 point : wall.points) {
        EXPECT_TRUE(IsWholeMillimetre(point.x) && IsWholeMillimetre(point.y)) << world.name;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, GeneratedWorlds,
                         testing::Values(WorldKind::kScatter, WorldKind::kMaze, WorldKind::kSpiral, WorldKind::kComb,
                                         WorldKind::kRing));

// Distances between the obstacles of a scatter, by points on one and the distance to the other.
std::vector<Point2> PointsOn(const Ring& ring) {
  std::vector<Point2> points;
  for (const Segment2& side : SidesOf(ring)) {
    for (int i = 0; i < 20; ++i) points.push_back(side.from + (i / 20.0) * (side.to - side.from));
  }
  return points;
}

TEST(ScatterAndRing, LeaveGapsBetweenAnyTwoObstacles) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const WorldKind kind = seed % 2 == 0 ? WorldKind::kScatter : WorldKind::kRing;
    const World whole = GenerateWorld({.kind = kind, .seed = seed, .gap = 0.8});
    std::size_t obstacles = 0;
    const auto expect_apart = [&](const std::vector<Point2>& points, const World& others) {
      for (const Point2 point : points) EXPECT_GE(ClearanceAt(others, point), 0.8) << seed;
      ++obstacles;
    };
    for (std::size_t i = 0; i < whole.polygons.size(); ++i) {
      World others = whole;
      others.polygons.erase(others.polygons.begin() + static_cast<std::ptrdiff_t>(i));
      expect_apart(PointsOn(whole.polygons[i].outline), others);
    }
    for (std::size_t i = 0; i < whole.boxes.size(); ++i) {
      World others = whole;
      others.boxes.erase(others.boxes.begin() + static_cast<std::ptrdiff_t>(i));
      expect_apart(PointsOn(CornersOf(whole.boxes[i])), others);
    }
    for (std::size_t i = 0; i < whole.cylinders.size(); ++i) {
      World others = whole;
      const CylinderObstacle cylinder = whole.cylinders[i];
      others.cylinders.erase(others.cylinders.begin() + static_cast<std::ptrdiff_t>(i));
      EXPECT_GE(ClearanceAt(others, cylinder.centre), 0.8 + cylinder.radius);
      ++obstacles;
    }
    EXPECT_GE(obstacles, 5u) << seed;
  }
}

TEST(Scatter, HasAsManyShapesAsAskedForIfThereIsRoom) {
  const World world = GenerateWorld({.kind = WorldKind::kScatter, .seed = 3, .width = 40, .height = 40, .count = 9});
  EXPECT_EQ(world.polygons.size() + world.boxes.size() + world.cylinders.size(), 9u);
}

TEST(Ring, HasAsManyRingsRoundStartAndGoalAsAskedFor) {
  const auto rings_round = [](const World& world, Point2 middle) {
    std::set<int> rings;
    for (const CylinderObstacle& cylinder : world.cylinders) {
      // The first ring's shapes are in the middle of 2.7 m (two gaps and a shape), each further one 2.4 m further out.
      const double ring = (Distance(cylinder.centre, middle) - 2 * 1.003 - 0.7) / (1.003 + 2 * 0.7);
      if (std::abs(ring - std::round(ring)) < 0.01) rings.insert(static_cast<int>(std::lround(ring)));
    }
    return rings.size();
  };
  std::size_t at_start = 0, at_goal = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const World world = GenerateWorld({.kind = WorldKind::kRing, .seed = seed, .width = 60, .count = 2});
    EXPECT_NEAR(Distance(Position(world.start), world.goal), 30.0, 1e-9);
    at_start += rings_round(world, Position(world.start));
    at_goal += rings_round(world, world.goal);
  }
  EXPECT_GT(at_start, 30u);
  EXPECT_GT(at_goal, 30u);
}

TEST(GeneratorOptions, AreRefusedOutOfTheirRanges) {
  EXPECT_EQ(FaultOf({}), "");
  EXPECT_EQ(FaultOf({.gap = 0.5}), "the gap must be between 0.7 and 5, not 0.5");
  EXPECT_EQ(FaultOf({.width = 3}), "the width must be between 8 and 200, not 3");
  EXPECT_EQ(FaultOf({.height = 9, .gap = 2}), "the height must be between 10 and 200, not 9");
  EXPECT_EQ(FaultOf({.count = -1}), "the count must be between 0 and 200, not -1");
  EXPECT_NE(FaultOf({.gap = std::nan("")}), "");
}

TEST(GeneratorOptions, HoldAtTheirEnds) {
  for (const WorldKind kind :
       {WorldKind::kScatter, WorldKind::kMaze, WorldKind::kSpiral, WorldKind::kComb, WorldKind::kRing}) {
    for (const bool is_enclosed : {false, true}) {
      for (const double gap : {kLeastGap, kGreatestGap}) {
        const GeneratorOptions options{
            .kind = kind, .width = 25, .height = 25, .gap = gap, .count = 12, .is_enclosed = is_enclosed};
        ASSERT_EQ(FaultOf(options), "");
        const World world = GenerateWorld(options);
        EXPECT_THAT(MessagesOf(FaultsOf(world)), testing::IsEmpty());
        EXPECT_GE(ClearanceAt(world, Position(world.start)), gap / 2 - 0.002);
        EXPECT_GE(ClearanceAt(world, world.goal), gap / 2 - 0.002);
      }
    }
  }
}

}  // namespace
}  // namespace runnel

#include "modules/simulation/algorithm/world_checks.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/simulation/algorithm/world_geometry.h"
#include "modules/types/algorithm/angle.h"

namespace runnel {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

auto Fault(WorldPart part, std::size_t index, const std::string& message) {
  return AllOf(Field(&WorldFault::part, part), Field(&WorldFault::index, index),
               Field(&WorldFault::message, HasSubstr(message)));
}

const Ring kSquare = {{1, 1}, {3, 1}, {3, 3}, {1, 3}};

World WithPolygon(Ring outline, std::vector<Ring> holes = {}) {
  return {.polygons = {{.outline = std::move(outline), .holes = std::move(holes)}}};
}

TEST(FaultsOf, FindsNothingWrongWithGoodObstacles) {
  EXPECT_THAT(FaultsOf(World{}), IsEmpty());
  EXPECT_THAT(FaultsOf(WithPolygon(kSquare, {{{1.5, 1.5}, {2, 1.5}, {2, 2}}})), IsEmpty());
  const Ring hook = {{1, 1}, {5, 1}, {5, 5}, {4, 5}, {4, 2}, {1, 2}};
  EXPECT_THAT(FaultsOf(WithPolygon(hook)), IsEmpty());
  EXPECT_THAT(FaultsOf(WithPolygon(Ring(hook.rbegin(), hook.rend()))), IsEmpty());
}

TEST(FaultsOf, FindsRingsThatCrossTouchOrFoldBack) {
  const auto crossing = ElementsAre(Fault(WorldPart::kPolygon, 0, "crosses or touches itself"));
  EXPECT_THAT(FaultsOf(WithPolygon({{1, 1}, {3, 3}, {3, 1}, {1, 3}})), crossing);
  EXPECT_THAT(FaultsOf(WithPolygon({{1, 1}, {5, 1}, {5, 3}, {3, 1}, {1, 3}})), crossing);
  EXPECT_THAT(FaultsOf(WithPolygon({{1, 1}, {3, 1}, {2, 1}, {2, 3}})), crossing);
  EXPECT_THAT(FaultsOf(WithPolygon({{1, 1}, {2, 1}, {3, 1}})), crossing);
  EXPECT_THAT(FaultsOf(WithPolygon({{1, 1}, {4, 1}, {4, 2}, {3, 2}, {3, 1}, {2, 1}, {2, 3}, {1, 3}})), crossing);
}

TEST(FaultsOf, FindsAPointGivenTwice) {
  EXPECT_THAT(FaultsOf(WithPolygon({{1, 1}, {3, 1}, {3, 3}, {1, 1}})),
              ElementsAre(Fault(WorldPart::kPolygon, 0, "without repeating its first point")));
  EXPECT_THAT(FaultsOf({.walls = {{.points = {{1, 1}, {1, 1}, {2, 2}}, .thickness = 0.1}}}),
              ElementsAre(Fault(WorldPart::kWall, 0, "(1, 1) twice in a row")));
}

TEST(FaultsOf, FindsTheHoleThatIsWrong) {
  const Ring good = {{1.2, 1.2}, {1.5, 1.2}, {1.5, 1.5}};
  const Ring outside = {{5, 5}, {6, 5}, {6, 6}};
  const Ring across = {{2, 2}, {5, 2}, {5, 2.5}};
  const Ring around_all = {{0.5, 0.5}, {4, 0.5}, {4, 4}, {0.5, 4}};
  for (const Ring& wrong : {outside, across, around_all}) {
    const auto faults = FaultsOf(WithPolygon(kSquare, {good, wrong}));
    ASSERT_THAT(faults, ElementsAre(Fault(WorldPart::kHole, 0, "not within its polygon")));
    EXPECT_EQ(faults[0].hole, 1U);
  }
  const Ring around_good = {{1.1, 1.1}, {1.8, 1.1}, {1.8, 1.8}, {1.1, 1.8}};
  EXPECT_THAT(FaultsOf(WithPolygon(kSquare, {good, around_good})),
              ElementsAre(Fault(WorldPart::kHole, 0, "meets another hole")));
}

TEST(FaultsOf, FindsTheStartInsideOfEachKindOfObstacle) {
  const Ring around = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  const World world{.polygons = {{.outline = kSquare}, {.outline = around}},
                    .boxes = {{.length = 1, .width = 1}},
                    .cylinders = {{.radius = 0.1}},
                    .walls = {{.points = {{-1, 0.04}, {1, 0.04}}, .thickness = 0.1}},
                    .bounds = kSquare};
  EXPECT_THAT(FaultsOf(world), ElementsAre(Fault(WorldPart::kPolygon, 1, "inside this obstacle"),
                                           Fault(WorldPart::kBox, 0, "inside this obstacle"),
                                           Fault(WorldPart::kCylinder, 0, "inside this obstacle"),
                                           Fault(WorldPart::kWall, 0, "inside this obstacle"),
                                           Fault(WorldPart::kBounds, 0, "outside the bounds")));
}

TEST(FaultsOf, FindsWhatIsNotFinite) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const World world{.start = {none, 0, 0},
                    .goal = {0, none},
                    .polygons = {{.outline = {{1, 1}, {none, 1}, {1, 3}}}},
                    .boxes = {{.pose = {5, 5, none}, .length = 1, .width = none}}};
  EXPECT_THAT(FaultsOf(world),
              ElementsAre(Fault(WorldPart::kStart, 0, "not finite"), Fault(WorldPart::kGoal, 0, "not finite"),
                          Fault(WorldPart::kPolygon, 0, "not finite"), Fault(WorldPart::kBox, 0, "not finite"),
                          Fault(WorldPart::kBox, 0, "the width")));
}

TEST(ClearanceAt, IsTheDistanceToTheNearestSurface) {
  const World world{.polygons = {{.outline = {{-9, -9}, {-5, -9}, {-5, -5}, {-9, -5}},
                                  .holes = {{{-8, -8}, {-6, -8}, {-6, -6}, {-8, -6}}}}},
                    .boxes = {{.pose = {0, 5, kPi / 2}, .length = 4, .width = 2}},
                    .cylinders = {{.centre = {5, 0}, .radius = 1}},
                    .walls = {{.points = {{0, -5}, {3, -5}}, .thickness = 0.5}},
                    .bounds = Ring{{-10, -10}, {10, -10}, {10, 10}, {-10, 10}}};
  EXPECT_NEAR(ClearanceAt(world, {-7, -7}), 1.0, 1e-12);       // in the middle of the room
  EXPECT_NEAR(ClearanceAt(world, {-8.25, -7}), -0.25, 1e-12);  // in its wall
  EXPECT_NEAR(ClearanceAt(world, {0, 2.5}), 0.5, 1e-12);
  EXPECT_NEAR(ClearanceAt(world, {0.9, 5}), -0.1, 1e-12);
  EXPECT_NEAR(ClearanceAt(world, {3, 0}), 1.0, 1e-12);
  EXPECT_NEAR(ClearanceAt(world, {4, -5}), 0.75, 1e-12);
  EXPECT_NEAR(ClearanceAt(world, {9.5, 9}), 0.5, 1e-12);
  EXPECT_NEAR(ClearanceAt(world, {11, 0}), -1.0, 1e-12);
  EXPECT_EQ(ClearanceAt(World{}, {1, 1}), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace runnel

#include "apps/arena/bounds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/types/algorithm/angle.h"

namespace runnel::arena {
namespace {

using testing::ElementsAre;

// Two boxes across the line, one beside it; grown by 0.35 m.
Course TwoBoxes() {
  Course course;
  course.world.start = {-10, 0, 0};
  course.world.goal = {10, 0};
  course.world.boxes.push_back({.pose = {-4, 0}, .length = 2, .width = 2});
  course.world.boxes.push_back({.pose = {4, 0}, .length = 1, .width = 3});
  course.world.boxes.push_back({.pose = {0, 8}, .length = 1, .width = 1});
  course.boundaries = ConfigurationSpace(course.world, 0.35).Boundaries();
  return course;
}

constexpr double kPerimeter = 8 + 2 * kPi * 0.35;  // of the first two alike
const std::vector<Point2> kHits{{-5.35, 0}, {3.15, 0}, {-5.35, 0.01}};

TEST(Bounds, CountEachBoundaryMetOnce) {
  EXPECT_EQ(BoundariesMet(TwoBoxes(), kHits).size(), 2u);
  EXPECT_THAT(BoundariesMet(TwoBoxes(), {}), ElementsAre());
}

TEST(Bounds, AreThoseOfTheirAuthors) {
  const Course course = TwoBoxes();
  EXPECT_NEAR(*BoundOf("bug1", course, kHits), 20 + 1.5 * 2 * kPerimeter, 1e-6);
  EXPECT_NEAR(*BoundOf("bug2", course, kHits), 20 + 2 * kPerimeter, 1e-6);
  EXPECT_NEAR(*BoundOf("alg1", course, kHits), 20 + 2 * 2 * kPerimeter, 1e-6);
  EXPECT_NEAR(*BoundOf("alg2", course, kHits), 20 + 2 * 2 * kPerimeter, 1e-6);
  EXPECT_NEAR(*BoundOf("bug2", course, {}), 20, 1e-12);
  EXPECT_EQ(BoundOf("tangent_bug", course, kHits), std::nullopt);
}

TEST(Bounds, OfBug2AllowAWholeLapRoundTheGoal) {
  Course course = TwoBoxes();
  course.world.goal = {4, 0};  // inside the second
  EXPECT_NEAR(*BoundOf("bug2", course, kHits), 14 + 2 * kPerimeter, 1e-6);
}

// Bug1 with infrared took 2,028 s to find that the goal in a spiral of 122 m cannot be reached, and was right.
TEST(TimeLimit, GrowsWithTheWallsThereAre) {
  Course course = TwoBoxes();
  EXPECT_NEAR(TimeLimitOf(course), 15 * (20 + 2 * kPerimeter + 4 + 2 * kPi * 0.35) / 0.3, 1e-3);
  course.world.goal = {-9, 0};
  course.boundaries.clear();
  EXPECT_EQ(TimeLimitOf(course), 300.0);
  course.boundaries = {{BoundaryPiece{.from = {0, 0}, .to = {122, 0}}}};
  EXPECT_GT(TimeLimitOf(course), 2 * 2028.0);
}

}  // namespace
}  // namespace runnel::arena

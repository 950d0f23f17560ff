#include "modules/simulation/algorithm/path_record.h"

#include <gtest/gtest.h>

namespace runnel {
namespace {

TEST(PathRecord, NeverGrowsBeyondItsCapacityAndKeepsTheEnds) {
  PathRecord record(8, 0.1);
  for (int i = 0; i <= 1000; ++i) record.Add({{0.05 * i, 0}, PathMode::kDrivingToGoal});
  const auto samples = record.Samples();
  EXPECT_LE(samples.size(), 9u);
  EXPECT_EQ(samples.front().position.x, 0);
  EXPECT_DOUBLE_EQ(samples.back().position.x, 50);
  EXPECT_NEAR(record.length(), 50, 1e-9);
}

TEST(PathRecord, KeepsAChangeOfModeHoweverShort) {
  PathRecord record(100, 1.0);
  record.Add({{0, 0}, PathMode::kDrivingToGoal});
  record.Add({{0.01, 0}, PathMode::kFollowingWall});
  record.Add({{0.02, 0}, PathMode::kDrivingToGoal});
  ASSERT_EQ(record.Samples().size(), 4u);
  EXPECT_EQ(record.Samples()[1].mode, PathMode::kFollowingWall);
}

TEST(PathRecord, SaysWhichPointsItKeepsAndCopiesThem) {
  PathRecord record(100, 1.0);
  EXPECT_TRUE(record.Add({{0, 0}, PathMode::kDrivingToGoal}));
  EXPECT_FALSE(record.Add({{0.5, 0}, PathMode::kDrivingToGoal}));
  EXPECT_TRUE(record.Add({{1.5, 0}, PathMode::kDrivingToGoal}));
  EXPECT_FALSE(record.Add({{1.6, 0}, PathMode::kDrivingToGoal}));
  std::vector<Point2> points = {{9, 9}};
  record.CopyPositions(points);
  EXPECT_EQ(points, (std::vector<Point2>{{0, 0}, {1.5, 0}}));
}

}  // namespace
}  // namespace runnel

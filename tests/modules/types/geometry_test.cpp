#include <gtest/gtest.h>

#include "modules/types/algorithm/angle.h"
#include "modules/types/algorithm/pose.h"
#include "modules/types/algorithm/segment.h"

namespace runnel {
namespace {

TEST(WrapAngleTest, LeadsIntoTheHalfOpenCircle) {
  EXPECT_DOUBLE_EQ(WrapAngle(3 * kPi), kPi);
  EXPECT_DOUBLE_EQ(WrapAngle(-kPi), kPi);
  EXPECT_DOUBLE_EQ(WrapAngle(0.5 - 4 * kPi), 0.5);
}

TEST(Pose2Test, BodyAndWorldFramesAreInverse) {
  const Pose2 pose{1.0, 2.0, kPi / 2};
  const Point2 world = ToWorld(pose, {1.0, 0.0});
  EXPECT_NEAR(world.x, 1.0, 1e-12);
  EXPECT_NEAR(world.y, 3.0, 1e-12);
  const Point2 body = ToBody(pose, world);
  EXPECT_NEAR(body.x, 1.0, 1e-12);
  EXPECT_NEAR(body.y, 0.0, 1e-12);
}

TEST(NearestPointTest, IsAnEndBeyondTheEnds) {
  const Segment2 segment{{0, 0}, {2, 0}};
  EXPECT_EQ(NearestPoint(segment, {1, 5}), (Point2{1, 0}));
  EXPECT_EQ(NearestPoint(segment, {-1, 5}), (Point2{0, 0}));
  EXPECT_EQ(NearestPoint(segment, {9, 5}), (Point2{2, 0}));
  EXPECT_EQ(NearestPoint(Segment2{{1, 1}, {1, 1}}, {9, 5}), (Point2{1, 1}));
}

TEST(WhereItMeetsTest, TellsThePartTravelledOrNothing) {
  const Segment2 travelled{{0, 0}, {4, 0}};
  EXPECT_EQ(WhereItMeets(travelled, {{1, -1}, {1, 1}}), 0.25);
  EXPECT_EQ(WhereItMeets(travelled, {{5, -1}, {5, 1}}), std::nullopt);
  EXPECT_EQ(WhereItMeets(travelled, {{1, 0}, {2, 0}}), std::nullopt);
}

}  // namespace
}  // namespace runnel

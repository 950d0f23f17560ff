#include "modules/adaptors/algorithm/adaptors.h"

#include <cmath>
#include <limits>
#include <type_traits>

#include "gmock/gmock.h"
#include "tests/modules/distances.h"

namespace runnel {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kField = DegreesToRadians(26.0);

static_assert(std::is_trivially_copyable_v<Surroundings>);

RangeScan Scan(float everywhere) { return {-kPi / 2, kPi / 180, 0.02, 4.0, std::vector<float>(181, everywhere)}; }
/// What a laser sees of a wall x = 1 in the world.
RangeScan ScanOfWall(const Pose2& pose) {
  RangeScan scan = Scan(kNothing);
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double direction = pose.heading + scan.start_angle + static_cast<double>(i) * scan.angle_step;
    const double range = (1.0 - pose.x) / std::cos(direction);
    if (range > 0.0 && range <= 4.0) scan.ranges[i] = static_cast<float>(range);
  }
  return scan;
}

TEST(LocalMap, KeepsAPointAtItsExactPlace) {
  LocalMap map;
  map.MarkBoundary({1.234, -0.567});
  int points = 0;
  map.ForEachBoundary([&](Point2 point) {
    ++points;
    EXPECT_EQ(point, (Point2{1.234, -0.567}));
  });
  EXPECT_EQ(points, 1);
}

TEST(LocalMap, FollowsTheRobotAndForgetsWhatIsFarAway) {
  LocalMap map;
  map.MarkBoundary({1.0, 0.0});
  map.SetPose({100.0, -50.0, 0});
  EXPECT_FALSE(map.Covers({1.0, 0.0}));
  int points = 0;
  map.ForEachBoundary([&](Point2) { ++points; });
  EXPECT_EQ(points, 0);
  map.MarkBoundary({100.5, -50.5});
  map.ForEachBoundary([&](Point2) { ++points; });
  EXPECT_EQ(points, 1);
}

TEST(LocalMap, DoesNotTakeAPlaceForAnotherOneWindowAway) {
  LocalMap map;
  map.MarkFree({0.5, 0.5});
  EXPECT_TRUE(map.IsFree({0.51, 0.51}));
  const double window = LocalMap::kCellsAcross * LocalMap::kCellSize;
  EXPECT_FALSE(map.IsFree({0.51 + window, 0.51}));
}

TEST(LaserAdaptor, KnowsNothingWithoutRays) { EXPECT_EQ(LaserAdaptor().Update(RangeScan{}, {}), Surroundings{}); }

TEST(LaserAdaptor, TellsRangesByBearing) {
  RangeScan scan = Scan(kNothing);
  scan.ranges[135] = 1.5F;  // 45 degrees to the left
  const Surroundings surroundings = LaserAdaptor().Update(scan, {2.0, 3.0, 1.0});
  EXPECT_EQ(surroundings.sensor_range, 4.0F);
  EXPECT_FALSE(surroundings.is_vague);
  EXPECT_NEAR(NearestBoundary(surroundings).distance, 1.5, 2e-3);
  EXPECT_NEAR(NearestBoundary(surroundings).bearing, kPi / 4, kSectorWidth);
}

// REP 117: -infinity is "too near to measure", NaN "no statement".
TEST(LaserAdaptor, WhatIsTooNearToMeasureIsABoundary) {
  for (const float range : {-kNothing, 0.0F, 0.01F}) {
    const Surroundings surroundings = LaserAdaptor().Update(Scan(range), {});
    EXPECT_TRUE(surroundings.is_measured);
    EXPECT_NEAR(NearestBoundary(surroundings).distance, 0.02, 1e-3) << range;
    EXPECT_EQ(FreeRange(surroundings, 0.0, 0.3), 0.0) << range;
  }
}

TEST(LaserAdaptor, KnowsNothingWhereHalfOfItsRaysSayNothing) {
  RangeScan scan = Scan(kNothing);
  for (std::size_t i = 1; i < scan.ranges.size(); i += 2) scan.ranges[i] = std::nanf("");
  EXPECT_TRUE(LaserAdaptor().Update(scan, {}).is_measured);
  scan.ranges[0] = std::nanf("");
  EXPECT_FALSE(LaserAdaptor().Update(scan, {}).is_measured);
}

// Else 40 % of the rays in a row would be a free way.
TEST(LaserAdaptor, KnowsNothingWhereItsRaysInARowSayNothing) {
  for (const std::size_t first : {0u, 80u, 170u}) {
    RangeScan scan = Scan(kNothing);
    for (std::size_t i = first; i < first + 10; ++i) scan.ranges[i] = std::nanf("");
    EXPECT_TRUE(LaserAdaptor().Update(scan, {}).is_measured) << first;
    scan.ranges[first == 0 ? 10 : first - 1] = std::nanf("");
    EXPECT_FALSE(LaserAdaptor().Update(scan, {}).is_measured) << first;
  }
}

TEST(LaserAdaptor, KnowsNothingWhereAGapLiesAcrossTheSeamOfAWholeTurn) {
  RangeScan scan{-kPi, kPi / 180, 0.02, 4.0, std::vector<float>(360, kNothing)};
  for (const std::size_t i : {0u, 1u, 2u, 3u, 4u, 355u, 356u, 357u, 358u, 359u}) scan.ranges[i] = std::nanf("");
  EXPECT_TRUE(LaserAdaptor().Update(scan, {}).is_measured);
  scan.ranges[5] = std::nanf("");
  EXPECT_FALSE(LaserAdaptor().Update(scan, {}).is_measured);
}

TEST(LaserAdaptor, RemembersWhatItNoLongerSees) {
  LaserAdaptor adaptor;
  (void)adaptor.Update(ScanOfWall({}), {});
  const Pose2 turned = {0.0, 0.0, kPi};
  const Surroundings behind = adaptor.Update(Scan(kNothing), turned);
  EXPECT_NEAR(NearestBoundary(behind).distance, 1.0, 5e-3);
  EXPECT_GT(std::abs(NearestBoundary(behind).bearing), kPi - 2 * kSectorWidth);
}

TEST(LaserAdaptor, RemembersInTheWorldNotInTheBody) {
  LaserAdaptor adaptor;
  (void)adaptor.Update(ScanOfWall({}), {});
  const Surroundings beside = adaptor.Update(Scan(kNothing), {0.6, 0.0, kPi});
  EXPECT_NEAR(NearestBoundary(beside).distance, 0.4, 5e-3);
}

TEST(LaserAdaptor, ForgetsWhatItLooksThrough) {
  LaserAdaptor adaptor;
  (void)adaptor.Update(ScanOfWall({}), {});
  EXPECT_EQ(NearestBoundary(adaptor.Update(Scan(kNothing), {})).distance, kInfinity);
}

TEST(LaserAdaptor, KeepsTheEdgeOfAnObstacleNextToFreeRays) {
  LaserAdaptor adaptor;
  RangeScan scan = Scan(kNothing);
  scan.ranges[90] = 1.0F;
  (void)adaptor.Update(scan, {});
  // Half a degree turned, so that the point lies between a ray that meets it and one that does not.
  const Surroundings surroundings = adaptor.Update(scan, {0.0, 0.0, DegreesToRadians(0.5)});
  EXPECT_NEAR(NearestBoundary(surroundings).distance, 1.0, 5e-3);
}

TEST(InfraredAdaptor, KnowsNothingFromRangersWithoutRange) {
  EXPECT_EQ(InfraredAdaptor().Update(InfraredRanges{}, {}), Surroundings{});
}

TEST(InfraredAdaptor, KnowsNothingWhereARangerSaysNothing) {
  const double no_number = std::nan("");
  for (const InfraredRanges& ranges :
       {InfraredRanges{no_number, 1.0, 1.0, 2.0, kField}, InfraredRanges{1.0, no_number, 1.0, 2.0, kField},
        InfraredRanges{1.0, 1.0, no_number, 2.0, kField}}) {
    EXPECT_FALSE(InfraredAdaptor().Update(ranges, {}).is_measured);
  }
}

TEST(InfraredAdaptor, WhatIsTooNearToMeasureIsABoundary) {
  const Surroundings surroundings = InfraredAdaptor().Update({-kInfinity, kInfinity, kInfinity, 2.0, kField}, {});
  EXPECT_TRUE(surroundings.is_measured);
  EXPECT_EQ(FreeRange(surroundings, 0.0, 0.3), 0.0);
}

TEST(InfraredAdaptor, TellsWhatAheadOfTheBodyNoConeHasLookedAt) {
  InfraredAdaptor adaptor;
  const auto look = [&](Pose2 pose) {
    return Unseen(adaptor.Update({kInfinity, kInfinity, kInfinity, 2.0, kField}, pose));
  };
  const BoundaryPoint beside_the_cone = look({});
  EXPECT_LT(beside_the_cone.distance, 0.05);
  EXPECT_GT(std::abs(beside_the_cone.bearing), kField / 2);
  EXPECT_LT(std::abs(beside_the_cone.bearing), kPi / 2);
  for (int degree = 5; degree <= 90; degree += 5) look({0, 0, DegreesToRadians(degree)});
  EXPECT_EQ(look({}).distance, kInfinity) << "now all round has been looked at";
  EXPECT_EQ(look({0.3, 0, 0}).distance, kInfinity) << "and what was far ahead, from there";
  EXPECT_LT(look({2.5, 0, DegreesToRadians(45.0)}).distance, 0.05);
}

TEST(InfraredAdaptor, TakesAnEchoForItsWholeArc) {
  const Surroundings surroundings = InfraredAdaptor().Update({1.0, kInfinity, kInfinity, 2.0, kField}, {});
  EXPECT_TRUE(surroundings.is_vague);
  EXPECT_NEAR(NearestBoundary(surroundings, 0.0, 0.05).distance, 1.0, 0.01);
  EXPECT_NEAR(NearestBoundary(surroundings, 0.2, 0.03).distance, 1.0, 0.01);
  EXPECT_EQ(NearestBoundary(surroundings, 0.5, 0.1).distance, kInfinity);
}

TEST(InfraredAdaptor, PutsTheThreeConesAheadLeftAndRight) {
  const Surroundings surroundings = InfraredAdaptor().Update({0.9, 0.6, 0.3, 2.0, kField}, {});
  EXPECT_NEAR(FrontDistance(surroundings), 0.9, 0.01);
  EXPECT_NEAR(LeftDistance(surroundings), 0.6, 0.01);
  EXPECT_NEAR(RightDistance(surroundings), 0.3, 0.01);
}

TEST(InfraredAdaptor, LooksThroughThePartsOfAnArcThatAreFree) {
  InfraredAdaptor adaptor;
  (void)adaptor.Update({1.0, kInfinity, kInfinity, 2.0, kField}, {});
  // Turned left by 13 degrees the cone sees nothing: the left half of the arc was free.
  const Surroundings surroundings = adaptor.Update({kInfinity, kInfinity, kInfinity, 2.0, kField}, {0, 0, kField / 2});
  EXPECT_EQ(NearestBoundary(surroundings, 0.0, 0.1).distance, kInfinity);
  EXPECT_NEAR(NearestBoundary(surroundings, -kField / 2 - 0.1, 0.08).distance, 1.0, 0.01);
}

TEST(InfraredAdaptor, DoesNotBelieveInWhatItLookedThroughBefore) {
  InfraredAdaptor adaptor;
  (void)adaptor.Update({kInfinity, kInfinity, kInfinity, 2.0, kField}, {});
  const Surroundings surroundings = adaptor.Update({1.0, kInfinity, kInfinity, 2.0, kField}, {0, 0, kField / 2});
  // The right half of the cone lies where nothing was.
  EXPECT_EQ(NearestBoundary(surroundings, -kField / 4, 0.05).distance, kInfinity);
  EXPECT_NEAR(NearestBoundary(surroundings, kField / 4, 0.05).distance, 1.0, 0.01);
}

TEST(InfraredAdaptor, BelievesANewEchoWhereAllWasFree) {
  InfraredAdaptor adaptor;
  (void)adaptor.Update({kInfinity, kInfinity, kInfinity, 2.0, kField}, {});
  const Surroundings surroundings = adaptor.Update({1.0, kInfinity, kInfinity, 2.0, kField}, {});
  EXPECT_NEAR(NearestBoundary(surroundings).distance, 1.0, 0.01);
}

TEST(InfraredAdaptor, AddsNothingToAnEchoThatIsExplained) {
  InfraredAdaptor adaptor;
  (void)adaptor.Update({1.0, kInfinity, kInfinity, 2.0, kField}, {});
  const Surroundings surroundings = adaptor.Update({1.0, kInfinity, kInfinity, 2.0, kField}, {0, 0, kField / 2});
  EXPECT_EQ(NearestBoundary(surroundings, 0.3, 0.1).distance, kInfinity);
}

TEST(InfraredAdaptor, RemembersAWallBehindIt) {
  InfraredAdaptor adaptor;
  (void)adaptor.Update({0.5, kInfinity, kInfinity, 2.0, kField}, {});
  const Surroundings surroundings = adaptor.Update({kInfinity, kInfinity, kInfinity, 2.0, kField}, {0.1, 0.0, kPi});
  EXPECT_NEAR(NearestBoundary(surroundings).distance, 0.4, 0.02);
}

TEST(BumperAdaptor, KnowsWhatItTouchedAndRemembersWhere) {
  BumperAdaptor adaptor;
  EXPECT_EQ(NearestBoundary(adaptor.Update({}, {})).distance, kInfinity);
  (void)adaptor.Update({true, 0.0}, {});
  const Surroundings behind = adaptor.Update({}, {0.0, 0.1, kPi});
  EXPECT_EQ(behind.sensor_range, 0.0F);
  EXPECT_NEAR(NearestBoundary(behind).distance, std::hypot(0.15, 0.1), 1e-3);
}

TEST(BumperAdaptor, DoesNotTakeASwitchThatSticksForNewTouches) {
  BumperAdaptor adaptor;
  (void)adaptor.Update({true, 0.0}, {});
  const Surroundings turned = adaptor.Update({true, 0.0}, {0.0, 0.0, kPi / 2});
  EXPECT_EQ(FrontDistance(turned), kInfinity) << "the switch is still pressed, by nothing new";
  EXPECT_NEAR(RightDistance(turned), 0.15, 1e-3);
}

TEST(BumperAdaptor, ForgetsWhatTheBodyHasPassedOver) {
  BumperAdaptor adaptor;
  (void)adaptor.Update({true, 0.0}, {});
  EXPECT_EQ(NearestBoundary(adaptor.Update({}, {0.1, 0.0, 0.0})).distance, kInfinity);
}

}  // namespace
}  // namespace runnel

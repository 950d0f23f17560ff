#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "modules/adaptors/sensors_to_surroundings.h"
#include "plugins/testing/module_rig.h"
#include "tests/modules/distances.h"

namespace runnel {
namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();

TEST(LaserToSurroundings, GivesOneViewForEachScan) {
  test::ModuleRig<LaserToSurroundings> rig;
  ASSERT_TRUE(rig.module.safe_distance.SetFromText("0.5"));
  ASSERT_TRUE(rig.Prepare());
  rig.Feed(rig.module.pose, {});
  rig.Feed(rig.module.measurement, RangeScan{-0.1, 0.1, 0.02, 4, {static_cast<float>(kNothing), 1.5F, 1.5F}});
  rig.RunCycle();
  rig.RunCycle();
  EXPECT_EQ(rig.module.surroundings.publications(), 1u);
  const Surroundings seen = rig.Last(rig.module.surroundings);
  EXPECT_NEAR(FrontDistance(seen), 1.5, 0.01);
  EXPECT_FLOAT_EQ(seen.safe_distance, 0.5F);
  EXPECT_FALSE(seen.is_vague);
}

TEST(LaserToSurroundings, WaitsUntilItKnowsWhereItIs) {
  test::ModuleRig<LaserToSurroundings> rig;
  ASSERT_TRUE(rig.Prepare());
  rig.Feed(rig.module.measurement, RangeScan{0, 0.1, 0.02, 4, {1.5F}});
  rig.RunCycle();
  EXPECT_EQ(rig.module.surroundings.publications(), 0u);
}

TEST(LaserToSurroundings, IsSilentWithAPoseThatIsOldOrNoNumber) {
  test::ModuleRig<LaserToSurroundings> rig;
  ASSERT_TRUE(rig.Prepare());
  const RangeScan scan{0, 0.1, 0.02, 4, {1.5F}};
  rig.Feed(rig.module.pose, {std::nan(""), 0.0, 0.0});
  rig.Feed(rig.module.measurement, scan);
  rig.RunCycle();
  EXPECT_EQ(rig.module.surroundings.publications(), 0u) << "no number";
  rig.Feed(rig.module.pose, {});
  rig.RunCycles(30);
  rig.Feed(rig.module.measurement, scan);
  rig.RunCycle();
  EXPECT_EQ(rig.module.surroundings.publications(), 0u) << "old";
  rig.Feed(rig.module.pose, {});
  rig.Feed(rig.module.measurement, scan);
  rig.RunCycle();
  EXPECT_EQ(rig.module.surroundings.publications(), 1u);
}

TEST(InfraredToSurroundings, GivesOneVagueViewForEachMeasurement) {
  test::ModuleRig<InfraredToSurroundings> rig;
  ASSERT_TRUE(rig.Prepare());
  rig.Feed(rig.module.pose, {});
  rig.Feed(
      rig.module.measurement,
      {.front = kNothing, .left = 0.8, .right = kNothing, .range_maximum = 2, .field_of_view = DegreesToRadians(26)});
  rig.RunCycle();
  rig.RunCycle();
  EXPECT_EQ(rig.module.surroundings.publications(), 1u);
  const Surroundings seen = rig.Last(rig.module.surroundings);
  EXPECT_NEAR(LeftDistance(seen), 0.8, 0.01);
  EXPECT_TRUE(seen.is_vague);
}

// What is within the body counts as free.
TEST(InfraredToSurroundings, RefusesASafeDistanceWithinTheBody) {
  test::ModuleRig<InfraredToSurroundings> rig;
  ASSERT_TRUE(rig.module.body_radius.SetFromText("0.4"));
  EXPECT_FALSE(rig.Prepare());
}

TEST(BumperToSurroundings, GivesOneViewForEachMessageTouchedOrNot) {
  test::ModuleRig<BumperToSurroundings> rig;
  ASSERT_TRUE(rig.Prepare());
  rig.Feed(rig.module.pose, {});
  rig.Feed(rig.module.measurement, {});
  rig.RunCycle();
  EXPECT_TRUE(rig.Last(rig.module.surroundings).is_measured);
  EXPECT_EQ(rig.Last(rig.module.surroundings).sensor_range, 0.0F);
  rig.Feed(rig.module.measurement, {true, kPi / 2});
  rig.RunCycle();
  EXPECT_EQ(rig.module.surroundings.publications(), 2u);
  EXPECT_NEAR(LeftDistance(rig.Last(rig.module.surroundings)), 0.15, 0.01);
}

TEST(BumperToSurroundings, RefusesASafeDistanceWithinTheBody) {
  test::ModuleRig<BumperToSurroundings> rig;
  ASSERT_TRUE(rig.module.safe_distance.SetFromText("0.1"));
  EXPECT_FALSE(rig.Prepare());
}

}  // namespace
}  // namespace runnel

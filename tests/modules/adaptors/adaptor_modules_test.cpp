#include <limits>

#include <gtest/gtest.h>

#include "modules/adaptors/infrared_to_surroundings.h"
#include "modules/adaptors/laser_to_surroundings.h"
#include "tests/support/module_rig.h"

namespace runnel {
namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();

TEST(LaserToSurroundings, GivesOneViewForEachScan) {
  test::ModuleRig<LaserToSurroundings> rig;
  ASSERT_TRUE(rig.module.safe_distance.SetFromText("0.5"));
  ASSERT_TRUE(rig.Prepare());
  rig.Feed(rig.module.pose, {});
  rig.Feed(rig.module.scan,
           RangeScan{-0.1, 0.1, 0.02, 4, {static_cast<float>(kNothing), 1.5F, 1.5F}});
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
  rig.Feed(rig.module.scan, RangeScan{0, 0.1, 0.02, 4, {1.5F}});
  rig.RunCycle();
  EXPECT_EQ(rig.module.surroundings.publications(), 0u);
}

TEST(InfraredToSurroundings, GivesOneVagueViewForEachMeasurement) {
  test::ModuleRig<InfraredToSurroundings> rig;
  ASSERT_TRUE(rig.Prepare());
  rig.Feed(rig.module.pose, {});
  rig.Feed(rig.module.ranges, {.front = kNothing,
                               .left = 0.8,
                               .right = kNothing,
                               .range_maximum = 2,
                               .field_of_view = DegreesToRadians(26)});
  rig.RunCycle();
  rig.RunCycle();
  EXPECT_EQ(rig.module.surroundings.publications(), 1u);
  const Surroundings seen = rig.Last(rig.module.surroundings);
  EXPECT_NEAR(LeftDistance(seen), 0.8, 0.01);
  EXPECT_TRUE(seen.is_vague);
}

}  // namespace
}  // namespace runnel

#include <cmath>
#include <limits>
#include <vector>

#include <gmock/gmock.h>

#include "modules/sensors/algorithm/median_filter.h"
#include "modules/sensors/scan_filter.h"
#include "plugins/testing/module_rig.h"

namespace runnel {
namespace {

using testing::ElementsAre;

constexpr float kNothing = std::numeric_limits<float>::infinity();

std::vector<float> Filtered(const std::vector<float>& values, std::size_t reach) {
  std::vector<float> filtered(values.size(), -1.0F);
  MedianFilter(values, reach, filtered);
  return filtered;
}

TEST(MedianFilter, TakesAwaySingleWrongValues) {
  EXPECT_THAT(Filtered({2, 2, 9, 2, 2}, 1), ElementsAre(2, 2, 2, 2, 2));
  EXPECT_THAT(Filtered({2, 2, kNothing, 2, 2}, 1), ElementsAre(2, 2, 2, 2, 2));
}

// REP 117: what says nothing. It counts as farthest, so that all of them are in an order.
TEST(MedianFilter, MakesNoNumbersOfWhatIsNone) {
  const float none = std::numeric_limits<float>::quiet_NaN();
  const auto filtered = Filtered({2, none, 2, none, none, none, 3, none, 1, none, none, 1, none, 2, 1, 1, 1}, 7);
  EXPECT_TRUE(std::isnan(Filtered({2, none, none, none, 2}, 1)[2]));
  EXPECT_THAT(Filtered({2, none, 2}, 1), ElementsAre(2, 2, 2));
  EXPECT_TRUE(std::isnan(filtered[8])) << "most of the fifteen round it say nothing";
}

TEST(MedianFilter, LeavesEdgesWhereTheyAre) {
  EXPECT_THAT(Filtered({1, 1, 1, 4, 4, 4}, 2), ElementsAre(1, 1, 1, 4, 4, 4));
}

TEST(MedianFilter, LeavesTheEndsAndShortListsAlone) {
  EXPECT_THAT(Filtered({9, 1, 1}, 3), ElementsAre(9, 1, 1));
  EXPECT_THAT(Filtered({5}, 3), ElementsAre(5));
  EXPECT_THAT(Filtered({}, 3), ElementsAre());
}

TEST(ScanFilter, KeepsAllOfTheScanButTheOutliers) {
  test::ModuleRig<ScanFilter> rig;
  ASSERT_TRUE(rig.Prepare());
  const RangeScan scan{-1, 0.5, 0.02, 4, {1, 1, 3, 1, 1}};
  rig.Feed(rig.module.raw, scan);
  rig.RunCycle();
  RangeScan expected = scan;
  expected.ranges = {1, 1, 1, 1, 1};
  EXPECT_EQ(rig.Last(rig.module.filtered), expected);
}

TEST(ScanFilter, PublishesOnceForEachScan) {
  test::ModuleRig<ScanFilter> rig;
  ASSERT_TRUE(rig.Prepare());
  rig.Feed(rig.module.raw, RangeScan{});
  rig.RunCycle();
  rig.RunCycle();
  EXPECT_EQ(rig.module.filtered.publications(), 1u);
}

}  // namespace
}  // namespace runnel

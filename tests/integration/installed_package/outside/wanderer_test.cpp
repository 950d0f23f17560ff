#include <gmock/gmock.h>
#include <runnel/testing.h>
#include <runnel/types.h>

using namespace runnel;
using namespace runnel::test;

RangeScan ScanOf(std::vector<float> ranges) {
  RangeScan scan;
  scan.ranges = std::move(ranges);
  return scan;
}

TEST(WandererTest, TurnsWhereSomethingIsNear) {
  ModuleRig rig("outside/wanderer");
  rig.Set("distance", "0.7");
  rig.Feed("scan", ScanOf({0.8f, 2}));
  EXPECT_THAT(rig, PublishesWithin(1, rig.output<Twist2>("twist"), Twist2{.forward = 0.4}));
  rig.Feed("scan", ScanOf({0.6f, 2}));
  EXPECT_THAT(rig, PublishesWithin(1, rig.output<Twist2>("twist"), Twist2{.turn = 1}));
}

TEST(WandererTest, KeepsRealTime) {
  ModuleRig rig("outside/wanderer");
  rig.Feed("scan", ScanOf({1, 2}));
  rig.RunCycles(20);
  EXPECT_THAT(rig, KeepsRealTime(10));
}

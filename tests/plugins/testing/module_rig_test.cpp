#include "plugins/testing/module_rig.h"

#include <gmock/gmock.h>

#include "modules/types/pose.h"
#include "tests/plugins/testing/adding_module.h"

namespace runnel::test {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;

// The text of the ElementError that `operation` throws.
template <typename Operation>
std::string Refusal(const Operation& operation) {
  try {
    operation();
  } catch (const ElementError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(ModuleRigTest, FeedsRunsAndShowsWhatHasBeenPublished) {
  ModuleRig<AddingModule> rig;
  rig.Feed(rig.module.values, 3);
  rig.RunCycles(2);
  EXPECT_EQ(rig.Last(rig.module.sum), 3);
  rig.Feed<double>("values", 4);
  rig.RunCycles(2);
  EXPECT_EQ(rig.Last<double>("sum"), 4);
}

TEST(ModuleRigTest, TimePassesByCyclesAndByWaiting) {
  ModuleRig<AddingModule> rig(milliseconds(10));
  rig.RunCycle();
  EXPECT_EQ(rig.module.seen_time, Time{});
  EXPECT_EQ(rig.module.seen_period, milliseconds(10));
  rig.Wait(milliseconds(5));
  rig.RunCycle();
  EXPECT_EQ(rig.module.seen_time, Time(milliseconds(15)));
  EXPECT_EQ(rig.now(), Time(milliseconds(25)));
  EXPECT_EQ(rig.runtime.clock().Now(), rig.now());
}

TEST(ModuleRigTest, ValuesWaitInAQueueWhereOneIsUsed) {
  ModuleRig<AddingModule> rig;
  rig.UseQueue("values", 2);
  for (const double value : {1, 2, 4}) rig.Feed("values", value);
  rig.RunCycles(2);
  EXPECT_EQ(rig.Last<double>("sum"), 6) << "the oldest of three has been dropped";
}

TEST(ModuleRigTest, FollowersSeeEachValue) {
  ModuleRig<AddingModule> rig;
  Input<double>& seen = rig.Follow(rig.module.sum);
  for (const double value : {1, 2, 3}) {
    rig.Feed("values", value);
    rig.RunCycles(2);
  }
  std::vector<double> sums;
  seen.Drain([&](const auto& sum) { sums.push_back(*sum); });
  EXPECT_THAT(sums, ElementsAre(1, 2, 3));
}

TEST(ModuleRigTest, FaultsAreFoundAsAnApplicationReportsThem) {
  ModuleRig<AddingModule> rig(milliseconds(10));
  rig.Set("limit", "5");
  rig.Feed("values", 6.0);
  const auto fault = rig.RunUntilFault(10);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->message, "the sum is too large: 6.000000");
  EXPECT_EQ(fault->path, "/module");
  EXPECT_EQ(fault->cycle, 2u);
  EXPECT_EQ(fault->time, Time(milliseconds(10)));
  rig.Feed("values", 1.0);
  EXPECT_FALSE(rig.RunUntilFault(10));
}

TEST(ModuleRigTest, WhatAModuleThrowsEndsATestThatDidNotExpectIt) {
  ModuleRig<AddingModule> rig;
  rig.Feed("values", 1e6);
  EXPECT_THROW(rig.RunCycles(2), std::runtime_error);
}

TEST(ModuleRigTest, WhatIsNotThereIsToldWithTheNearestName) {
  ModuleRig<AddingModule> rig;
  EXPECT_THAT(Refusal([&] { rig.Feed("valeus", 1.0); }), HasSubstr("did you mean 'values'?"));
  EXPECT_THAT(Refusal([&] { rig.Set("limits", "1"); }), HasSubstr("did you mean 'limit'?"));
  EXPECT_THAT(Refusal([&] { rig.Set("limit", "-1"); }), HasSubstr("-1"));
  EXPECT_THAT(Refusal([&] { rig.Feed("lists", 1.0); }), HasSubstr("list"));
  EXPECT_THAT(Refusal([&] { (void)rig.Last<int>("sum"); }), HasSubstr("an output of type"));
}

TEST(ModuleRigTest, MakesModulesOfPlugins) {
  ModuleRig rig("motion/differential_drive");
  rig.Feed("twist", Twist2{.forward = 0.1});
  rig.RunCycles(2);
  const auto wheels = rig.Last<WheelSpeeds>("wheels");
  EXPECT_GT(wheels.left, 0);
  EXPECT_EQ(wheels.left, wheels.right);
}

TEST(ModuleRigTest, TypesAndPluginsThatAreNotThereAreToldWithTheNearestName) {
  EXPECT_THAT(Refusal([] { ModuleRig rig("motion/differential_drives"); }),
              HasSubstr("did you mean 'motion/differential_drive'?"));
  EXPECT_THAT(Refusal([] { ModuleRig rig("motoin/drive"); }), HasSubstr("no plugin 'motoin'"));
}

}  // namespace
}  // namespace runnel::test

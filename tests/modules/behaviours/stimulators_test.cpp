#include <cmath>

#include <gmock/gmock.h>

#include "modules/behaviours/conditional_stimulator.h"
#include "modules/behaviours/number_to_activity.h"
#include "plugins/testing/matchers.h"
#include "plugins/testing/module_rig.h"

namespace runnel {
namespace {

using test::HasPublished;
using test::KeepsRealTime;
using test::ModuleRig;

struct ConditionalStimulatorTest : ::testing::Test {
  ConditionalStimulatorTest() {
    rig.Set("inputs", "2");
    rig.Set("feedbacks", "1");
    rig.Set("stimulation_mode", "auto");
    rig.Feed("stimulation", Stimulation(0.75));
    Feed(0, 0, 0);
  }
  void Feed(double first, double second, double feedback) {
    rig.Feed("input1", first);
    rig.Feed("input2", second);
    rig.Feed("feedback1", feedback);
  }
  bool IsActive() {
    rig.RunCycle();
    const double active = rig.Last(rig.module.activity).value();
    EXPECT_EQ(active, rig.Last(rig.module.target_rating).value() * 0.75);
    return active > 0.0;
  }

  ModuleRig<ConditionalStimulator> rig;
};

TEST_F(ConditionalStimulatorTest, IsActiveWhileAllConditionsHold) {
  EXPECT_FALSE(IsActive());
  Feed(1, 0, 0);
  EXPECT_FALSE(IsActive());
  Feed(1, 1, 0);
  EXPECT_TRUE(IsActive());
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.75)));
  Feed(0, 1, 0);
  EXPECT_FALSE(IsActive());
  rig.RunCycle();
  rig.Set("input1_relation", "less");
  EXPECT_TRUE(IsActive());
  rig.Set("input2_threshold", "2");
  EXPECT_FALSE(IsActive());
}

TEST_F(ConditionalStimulatorTest, OneStepAfterTheOther) {
  ASSERT_TRUE(rig.Prepare());
  rig.Set("input1_kind", "ordering");
  Feed(1, 0, 0);
  EXPECT_FALSE(IsActive());
  Feed(0, 1, 0);
  EXPECT_TRUE(IsActive()) << "the first has held before";
  Feed(0, 1, 1);
  EXPECT_TRUE(IsActive());
  EXPECT_FALSE(IsActive()) << "the feedback has ended it";
  Feed(1, 1, 0);
  EXPECT_TRUE(IsActive()) << "and it begins anew";
}

TEST_F(ConditionalStimulatorTest, ASignalResetsIt) {
  ASSERT_TRUE(rig.Prepare());
  rig.Set("input1_kind", "ordering");
  Feed(1, 1, 0);
  EXPECT_TRUE(IsActive());
  Feed(0, 1, 0);
  EXPECT_TRUE(IsActive());
  rig.Feed("reset", Signal{});
  EXPECT_FALSE(IsActive());
  EXPECT_FALSE(IsActive());
}

TEST_F(ConditionalStimulatorTest, TakesActivitiesAndTargetRatings) {
  ASSERT_TRUE(rig.Prepare());
  Runtime& runtime = rig.runtime;
  auto& group = runtime.Create<Group>(runtime.root(), "others");
  Output<TargetRating> rating(group, "rating");
  Output<Activity> activity(group, "activity");
  auto& first = rig.input<double>("input1");
  auto& second = rig.input<double>("input2");
  first.DisconnectAll();
  second.DisconnectAll();
  ASSERT_TRUE(Port::Connect(rating, first));
  ASSERT_TRUE(Port::Connect(activity, second));
  rating.Publish(TargetRating(0.75));
  activity.Publish(Activity(0.75));
  EXPECT_TRUE(IsActive());
  first.DisconnectAll();
  second.DisconnectAll();
}

TEST_F(ConditionalStimulatorTest, AllocatesNothingInItsCycles) {
  rig.RunCycles(10);
  EXPECT_THAT(rig, KeepsRealTime(100));
}

TEST_F(ConditionalStimulatorTest, IsNotActiveByConditionsOfWhichNothingIsHeard) {
  const auto stimulate = [this] {
    rig.Feed("stimulation", Stimulation(0.75));
    rig.RunCycle();
    return rig.Last(rig.module.activity).value();
  };
  Feed(1, 1, 0);
  for (int i = 0; i < 11; ++i) EXPECT_EQ(stimulate(), 0.75);  // 0.5 s
  EXPECT_EQ(stimulate(), 0.0);
  rig.Feed("input1", 1.0);
  EXPECT_EQ(stimulate(), 0.0) << "the second one is old";
  Feed(1, 1, 0);
  EXPECT_EQ(stimulate(), 0.75);
}

TEST(NumberToActivityTest, MakesNothingOfANumberThatIsOldOrNone) {
  ModuleRig<NumberToActivity> rig;
  rig.Set("stimulation_mode", "enabled");
  rig.Set("shape", "linear");
  rig.Feed("number", 0.5);
  for (int i = 0; i < 12; ++i) {
    rig.RunCycle();
    EXPECT_EQ(rig.Last(rig.module.activity).value(), i < 11 ? 0.5 : 0.0) << i;
  }
  rig.Feed("number", std::nan(""));
  rig.RunCycle();
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.0)));
  rig.Feed("number", 0.5);
  rig.RunCycle();
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.5)));
}

TEST(NumberToActivityTest, FollowsItsCurve) {
  ModuleRig<NumberToActivity> rig;
  rig.Set("stimulation_mode", "enabled");
  rig.Set("shape", "linear");
  rig.Set("end", "4");
  rig.Feed("number", 1.0);
  rig.RunCycle();
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.25)));
  EXPECT_THAT(rig.module.target_rating, HasPublished(TargetRating(0.25)));
  rig.Set("curve", "fall");
  rig.RunCycle();
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.75)));
  rig.Set("end", "-1");
  rig.Feed("number", 7.0);
  rig.RunCycle();
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.0))) << "it cannot tell: no curve";
  rig.RunCycles(10);
  EXPECT_THAT(rig, KeepsRealTime(100));
}

}  // namespace
}  // namespace runnel

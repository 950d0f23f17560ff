#include "modules/behaviours/fusion.h"

#include <array>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "core/log/log_sink.h"
#include "core/port/output.h"
#include "modules/types/pose.h"
#include "plugins/testing/matchers.h"
#include "plugins/testing/module_rig.h"

namespace runnel {

struct Mixed {
  std::array<float, 2> pair{};
  std::int32_t whole = 0;
  bool flag = false;
};
inline void Describe(TypeBuilder<Mixed>& type) {
  type.Name("TestMixed").Field("pair", &Mixed::pair).Field("whole", &Mixed::whole).Field("flag", &Mixed::flag);
}
struct Named {
  std::string name;
};
inline void Describe(TypeBuilder<Named>& type) { type.Name("TestNamed").Field("name", &Named::name); }

namespace {

using test::HasPublished;
using test::KeepsRealTime;
using test::ModuleRig;
using ::testing::AllOf;
using ::testing::DoubleEq;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;

template <typename T>
void FeedChannel(ModuleRig<FusionBehaviour>& rig, int channel, double activity, double rating, T value) {
  const std::string number = std::to_string(channel);
  rig.Feed("activity" + number, Activity(activity));
  rig.Feed("target_rating" + number, TargetRating(rating));
  rig.Feed<T>("in" + number, std::move(value));
}

struct FusionTest : ::testing::Test {
  FusionTest() {
    rig.Set("type", TypeOf<Twist2>().name());
    rig.Set("stimulation_mode", "enabled");
  }

  Runtime other;
  Output<Twist2> makes_twists_known{other.root(), "twist"};
  Output<Pose2> makes_poses_known{other.root(), "pose"};
  Output<Mixed> makes_mixed_known{other.root(), "mixed"};
  Output<Named> makes_named_known{other.root(), "named"};
  ModuleRig<FusionBehaviour> rig;

  // What is fed once counts for as long as the test lasts.
  void NothingGrowsOld() {
    for (const char* timeout : {"activity_timeout", "target_rating_timeout", "in_timeout"}) rig.Set(timeout, "3600");
  }
};

TEST_F(FusionTest, TheWinnerTakesAll) {
  rig.Set("method", "winner_takes_all");
  rig.Set("stimulation_mode", "auto");
  rig.Feed("stimulation", Stimulation(0.5));
  FeedChannel(rig, 1, 0.25, 1.0, Twist2{1, 1});
  FeedChannel(rig, 2, 0.5, 0.75, Twist2{2, 2});
  rig.RunCycle();
  EXPECT_THAT(rig.output<Twist2>("out"), HasPublished(Twist2{2, 2}));
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.25)));
  EXPECT_THAT(rig.module.target_rating, HasPublished(TargetRating(0.75)));
  FeedChannel(rig, 1, 0.5, 1.0, Twist2{1, 1});
  rig.RunCycle();
  EXPECT_THAT(rig.output<Twist2>("out"), HasPublished(Twist2{1, 1})) << "the first of the greatest";
}

TEST_F(FusionTest, AveragesNumberByNumber) {
  FeedChannel(rig, 1, 0.25, 1.0, Twist2{1, 0});
  FeedChannel(rig, 2, 0.75, 0.0, Twist2{2, -4});
  rig.RunCycle();
  EXPECT_THAT(rig.output<Twist2>("out"), HasPublished(Twist2{1.75, -3}));
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.625)));
  EXPECT_THAT(rig.module.target_rating, HasPublished(TargetRating(0.25)));
}

TEST_F(FusionTest, SumsInPartsOfTheGreatest) {
  rig.Set("method", "weighted_sum");
  FeedChannel(rig, 1, 0.25, 1.0, Twist2{1, 0});
  FeedChannel(rig, 2, 0.5, 0.0, Twist2{2, -4});
  rig.RunCycle();
  EXPECT_THAT(rig.output<Twist2>("out"), HasPublished(Twist2{2.5, -4}));
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.625)));
}

TEST_F(FusionTest, HeadingsAreAveragedAsDirections) {
  rig.Set("type", "Pose2");
  FeedChannel(rig, 1, 0.5, 0.0, Pose2{1, 2, 3.0});
  FeedChannel(rig, 2, 0.5, 0.0, Pose2{3, 4, -3.0});
  rig.RunCycle();
  EXPECT_THAT(rig.output<Pose2>("out"),
              HasPublished(AllOf(Field(&Pose2::x, 2.0), Field(&Pose2::heading, DoubleNear(M_PI, 1e-9)))));
}

TEST_F(FusionTest, PlainNumbersMayBeAnglesToo) {
  rig.Set("type", "double");
  rig.Set("unit", "rad");
  FeedChannel(rig, 1, 0.5, 0.0, 3.0);
  FeedChannel(rig, 2, 0.5, 0.0, -3.0);
  rig.RunCycle();
  EXPECT_THAT(rig.output<double>("out"), HasPublished(DoubleNear(M_PI, 1e-9)));
}

TEST_F(FusionTest, WhatIsNoNumberIsTheWinners) {
  rig.Set("type", "TestMixed");
  FeedChannel(rig, 1, 0.25, 0.0, Mixed{{1, 2}, 10, true});
  FeedChannel(rig, 2, 0.75, 0.0, Mixed{{3, 6}, 20, false});
  rig.RunCycle();
  EXPECT_THAT(rig.output<Mixed>("out"), HasPublished(AllOf(Field(&Mixed::pair, ElementsAre(2.5F, 5.0F)),
                                                           Field(&Mixed::whole, 18), Field(&Mixed::flag, false))));
}

TEST_F(FusionTest, TextsCannotBeWeighed) {
  rig.Set("type", "TestNamed");
  const auto prepared = rig.Prepare();
  ASSERT_FALSE(prepared);
  EXPECT_EQ(
      prepared.error().ToString(),
      "/module/parameter/method: values of type TestNamed cannot be weighted: there is 'string' in them, which is "
      "neither a number nor of a fixed size; the method winner_takes_all takes values of any type");
}

TEST_F(FusionTest, TheWinnersTextIsPassedOnAsItIs) {
  rig.Set("type", "TestNamed");
  rig.Set("method", "winner_takes_all");
  FeedChannel(rig, 1, 0.25, 0.0, Named{"one"});
  FeedChannel(rig, 2, 0.75, 0.0, Named{"two"});
  rig.RunCycle();
  EXPECT_THAT(rig.output<Named>("out"), HasPublished(Field(&Named::name, "two")));
  bool is_same = false;
  rig.output<Named>("out").VisitLatest([&](const void* value, ValueTimes) {
    rig.input<Named>("in2").VisitLatest([&](const void* source, ValueTimes) { is_same = value == source; });
  });
  EXPECT_TRUE(is_same);
  const auto fault = (rig.Set("method", "weighted_sum"), rig.RunUntilFault());
  ASSERT_TRUE(fault);
  EXPECT_THAT(fault->message, HasSubstr("cannot be weighted"));
}

// What a fusion passes on where nobody is active, nobody wants.
TEST_F(FusionTest, StandsStillWhereNobodyIsActive) {
  for (const char* method : {"winner_takes_all", "weighted_average", "weighted_sum"}) {
    rig.Set("method", method);
    FeedChannel(rig, 1, 0.0, 1.0, Twist2{0.2, 0.3});
    FeedChannel(rig, 2, 0.0, 0.5, Twist2{0.4, 0.3});
    rig.RunCycle();
    EXPECT_THAT(rig.output<Twist2>("out"), HasPublished(Twist2{})) << method;
    EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.0)));
  }
}

TEST_F(FusionTest, IsSilentWhereNobodyIsActiveAndZeroIsNoStandstill) {
  rig.Set("type", "Pose2");
  for (const char* method : {"winner_takes_all", "weighted_average", "weighted_sum"}) {
    rig.Set("method", method);
    FeedChannel(rig, 1, 0.0, 1.0, Pose2{1, 2, 3});
    FeedChannel(rig, 2, 0.0, 0.5, Pose2{3, 2, 1});
    rig.RunCycle();
    EXPECT_EQ(rig.output<Pose2>("out").publications(), 0u) << method;
  }
}

TEST_F(FusionTest, WhatItMakesIsAsOldAsTheOldestOfIt) {
  for (const char* method : {"winner_takes_all", "weighted_average", "weighted_sum"}) {
    rig.Set("method", method);
    FeedChannel(rig, 1, 0.25, 1.0, Twist2{0.2, 0.3});
    const Time oldest = rig.now();
    rig.RunCycles(3);
    FeedChannel(rig, 2, 0.5, 1.0, Twist2{0.2, 0.3});
    rig.RunCycle();
    for (const char* output : {"out", "activity"}) {
      Time stamp{};
      dynamic_cast<Port&>(**rig.module.Find("output/" + std::string(output)))
          .VisitLatest([&](const void*, ValueTimes times) { stamp = times.timestamp; });
      EXPECT_EQ(stamp, oldest) << method << " " << output;
    }
  }
}

TEST_F(FusionTest, SaysNothingUntilAllWhoAreActiveHaveSaidWhatTheyWant) {
  rig.Feed("activity1", Activity(0.5));
  rig.Feed("target_rating1", TargetRating(0.5));
  rig.Feed("in1", Twist2{1, 1});
  rig.RunCycle();
  EXPECT_EQ(rig.output<Twist2>("out").publications(), 0u) << "channel 2 has no activity";
  rig.Feed("activity2", Activity(0.5));
  rig.Feed("target_rating2", TargetRating(0.5));
  rig.RunCycle();
  EXPECT_EQ(rig.output<Twist2>("out").publications(), 0u) << "channel 2 is active and has no value";
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.0)));
  rig.Feed("activity2", Activity(0.0));
  rig.RunCycle();
  EXPECT_THAT(rig.output<Twist2>("out"), HasPublished(Twist2{1, 1})) << "who does nothing need not want anything";
}

// One parameter for all channels, as for inhibitions.
TEST_F(FusionTest, IsActiveInNothingOnceSomethingIsOld) {
  const auto feed = [&](const std::string& lost) {
    for (int i : {1, 2}) {
      const std::string number = std::to_string(i);
      if (lost != "activity" || i == 1) rig.Feed("activity" + number, Activity(0.5));
      if (lost != "target_rating" || i == 1) rig.Feed("target_rating" + number, TargetRating(0.5));
      if (lost != "in" || i == 1) rig.Feed("in" + number, Twist2{1, 0});
    }
    rig.RunCycle();
  };
  std::vector<std::string> told;
  const LogSink sink(rig.runtime, [&](const LogMessage& message) { told.push_back(message.text); });
  rig.Set("warning_interval", "1");
  for (const std::string lost : {"activity", "target_rating", "in"}) {
    feed("");
    EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.5))) << lost;
    for (int i = 0; i < 10; ++i) feed(lost);  // 0.5 s
    const auto published = rig.output<Twist2>("out").publications();
    feed(lost);
    EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.0))) << lost;
    EXPECT_EQ(rig.output<Twist2>("out").publications(), published) << lost;
    FlushLog();
    EXPECT_THAT(told, ::testing::Contains(lost + " is old"));
    rig.Set(lost + "_timeout", "10");
    feed(lost);
    EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.5))) << lost;
  }
}

TEST_F(FusionTest, AllocatesNothingInItsCycles) {
  NothingGrowsOld();
  rig.Set("channels", "8");
  for (int i = 1; i <= 8; ++i) FeedChannel(rig, i, 0.125 * i, 0.5, Twist2{1.0 * i, 1});
  for (const char* method : {"winner_takes_all", "weighted_average", "weighted_sum"}) {
    rig.Set("method", method);
    rig.RunCycles(10);
    EXPECT_THAT(rig, KeepsRealTime(100)) << method;
  }
}

TEST_F(FusionTest, PassesLargeValuesOnWithoutAllocating) {
  NothingGrowsOld();
  rig.Set("type", "TestNamed");
  rig.Set("method", "winner_takes_all");
  FeedChannel(rig, 1, 0.25, 0.0, Named{std::string(1000, 'a')});
  FeedChannel(rig, 2, 0.75, 0.0, Named{std::string(1000, 'b')});
  rig.RunCycles(10);
  EXPECT_THAT(rig, KeepsRealTime(100));
}

}  // namespace
}  // namespace runnel

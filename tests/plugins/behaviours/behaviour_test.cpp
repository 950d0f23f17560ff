#include "plugins/behaviours/behaviour.h"

#include <gmock/gmock.h>

#include "plugins/testing/matchers.h"
#include "plugins/testing/module_rig.h"

namespace runnel {
namespace {

using test::HasPublished;
using test::KeepsRealTime;
using test::ModuleRig;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Does what it is told by numbers.
class Told final : public Behaviour {
 public:
  using Behaviour::Behaviour;
  Input<Activity> seen{this, "seen"};
  ControlOutput<double> out{this, "out"};
  ControlOutput<std::vector<double>> list{this, "list"};
  DerivedActivity half{this, "half"};
  Parameter<double> gain{this, "gain", {.default_value = 1.0}};

  double part = 1.0;  // of the activation
  double rating = 0.5;
  double derived = 0.0;
  bool can_tell = true;
  double activation = -1.0;

 private:
  std::optional<Outcome> Behave(double with) override {
    activation = with;
    out.Set(7.0);
    if (auto& loan = list.Fill()) loan->assign(3, with);
    half.Set(derived);
    if (!can_tell) return Miss("nobody has told it");
    return Outcome{.activity = with * part, .target_rating = rating};
  }
};

TEST(BehaviourTest, PublishesWhatItDoesAndHowItIs) {
  ModuleRig<Told> rig;
  rig.Set("inhibitions", "2");
  rig.Feed("stimulation", Stimulation(0.8));
  rig.Feed("inhibition2", Inhibition(0.5));
  rig.module.part = 0.5;
  rig.module.derived = 0.1;
  rig.RunCycle();
  EXPECT_DOUBLE_EQ(rig.module.activation, 0.4) << "inhibition1 is not connected";
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.2)));
  EXPECT_THAT(rig.module.target_rating, HasPublished(TargetRating(0.5)));
  EXPECT_THAT(rig.module.half.port, HasPublished(Activity(0.1)));
  EXPECT_THAT(rig.module.out.port, HasPublished(7.0));
  EXPECT_THAT(rig.module.list.port, HasPublished(ElementsAre(0.4, 0.4, 0.4)));
  EXPECT_THAT(rig.module.state, HasPublished(BehaviourState{0.4, 0.2, 0.5, StimulationMode::kAuto}));
}

TEST(BehaviourTest, TheModeBeatsThePort) {
  ModuleRig<Told> rig;
  rig.RunCycle();
  EXPECT_EQ(rig.module.activation, 0.0) << "nothing comes to the stimulation";
  rig.Set("stimulation_mode", "enabled");
  rig.RunCycle();
  EXPECT_EQ(rig.module.activation, 1.0);
  rig.Feed("stimulation", Stimulation(0.25));
  rig.RunCycle();
  EXPECT_EQ(rig.module.activation, 1.0);
  rig.Set("stimulation_mode", "disabled");
  rig.RunCycle();
  EXPECT_EQ(rig.module.activation, 0.0);
  rig.Set("stimulation_mode", "auto");
  rig.RunCycle();
  EXPECT_EQ(rig.module.activation, 0.25);
  rig.Feed("inhibition1", Inhibition(1.0));
  rig.Set("stimulation_mode", "enabled");
  rig.RunCycle();
  EXPECT_EQ(rig.module.activation, 0.0) << "inhibitions count in every mode";
}

TEST(BehaviourTest, WhatBreaksARuleIsNotPublished) {
  ModuleRig<Told> rig;
  rig.Set("stimulation_mode", "enabled");
  rig.module.rating = 1.5;
  const auto fault = rig.RunUntilFault();
  ASSERT_TRUE(fault);
  EXPECT_THAT(fault->message, HasSubstr("target rating is 1.5, which is not within 0 and 1"));
  EXPECT_EQ(rig.module.activity.publications(), 0u);
  EXPECT_EQ(rig.module.state.publications(), 0u);
  EXPECT_EQ(rig.module.out.port.publications(), 0u);
  EXPECT_EQ(rig.module.list.port.publications(), 0u);
  EXPECT_EQ(rig.module.half.port.publications(), 0u);
}

/// Fails when it has filled its only buffer.
class FailsWithItsBuffer final : public Behaviour {
 public:
  using Behaviour::Behaviour;
  ControlOutput<std::vector<double>> list{this, "list", {.pool = {.buffers = 1, .may_grow = false}}};

 private:
  std::optional<Outcome> Behave(double with) override {
    list.Set({with});
    throw std::runtime_error("has failed");
  }
};

TEST(BehaviourTest, WhoHasFailedKeepsNoBuffer) {
  ModuleRig<FailsWithItsBuffer> rig;
  ASSERT_TRUE(rig.RunUntilFault());
  EXPECT_TRUE(rig.module.list.port.Loan());
}

TEST(BehaviourTest, AFaultTellsTheFigures) {
  const auto message_of = [](auto&& prepare) {
    ModuleRig<Told> rig;
    rig.Feed("stimulation", Stimulation(0.5));
    rig.Feed("seen", Activity(0.0));
    rig.RunCycle();
    prepare(rig);
    const auto fault = rig.RunUntilFault();
    return fault ? fault->message : "no fault";
  };
  EXPECT_THAT(message_of([](auto& rig) { rig.module.part = 1.5; }),
              HasSubstr("its activity 0.75 is greater than its activation 0.5"));
  EXPECT_THAT(message_of([](auto& rig) { rig.module.derived = 0.75; }),
              HasSubstr("its derived activity 1 is 0.75, which is not within 0 and its activity 0.5"));
  EXPECT_THAT(message_of([](auto& rig) {
                rig.module.rating = 0.0;
                rig.RunCycle();
                rig.module.part = 0.5;
              }),
              HasSubstr("its activity has changed from 0.5 to 0.25 in the goal state"));
  EXPECT_EQ(message_of([](auto& rig) {
              rig.module.rating = 0.0;
              rig.RunCycle();
              rig.module.part = 0.5;
              rig.Feed("seen", Activity(0.5));
            }),
            "no fault")
      << "an activity that it reads has changed";
  EXPECT_EQ(message_of([](auto& rig) {
              rig.module.rating = 0.0;
              rig.RunCycle();
              rig.module.part = 0.5;
              rig.Set("gain", "2");
            }),
            "no fault")
      << "a parameter has changed";
}

TEST(BehaviourTest, WhatIsSetByHandMustBeASignal) {
  ModuleRig<Told> rig;
  auto& port = rig.input<Stimulation>("stimulation");
  ASSERT_TRUE(rig.Prepare());
  ASSERT_TRUE(port.PublishByHand([](void* value) { return SetFromText(TypeOf<Stimulation>(), "{value: 7}", value); }));
  const auto fault = rig.RunUntilFault();
  ASSERT_TRUE(fault);
  EXPECT_THAT(fault->message, HasSubstr("its stimulation is 7, which is not within 0 and 1"));
}

TEST(BehaviourTest, WhoCannotTellIsActiveInNothing) {
  ModuleRig<Told> rig;
  rig.Feed("stimulation", Stimulation(0.5));
  rig.module.derived = 0.5;
  rig.RunCycle();
  auto& out = rig.Follow(rig.module.out.port);
  while (out.Take()) {
  }
  rig.module.can_tell = false;
  rig.RunCycle();
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.0)));
  EXPECT_THAT(rig.module.half.port, HasPublished(Activity(0.0)));
  EXPECT_THAT(rig.module.target_rating, HasPublished(TargetRating(0.5)));
  EXPECT_FALSE(out.Take()) << "what it had begun is dropped";
  rig.module.can_tell = true;
  rig.module.derived = 0.0;
  rig.RunCycle();
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.5)));
  EXPECT_TRUE(out.Take());
}

// Of an inhibitor that is paused or stuck the last word stands: "not inhibited" is not to be believed for ever.
TEST(BehaviourTest, WhoIsNotToldAnyMoreWhetherItMayIsActiveInNothing) {
  ModuleRig<Told> rig;
  rig.Feed("stimulation", Stimulation(0.5));
  const auto tell = [&](bool inhibits) {
    if (inhibits) rig.Feed("inhibition1", Inhibition(0.0));
    rig.RunCycle();
    return rig.Last(rig.module.activity).value();
  };
  EXPECT_EQ(tell(true), 0.5);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(tell(false), 0.5);  // 0.5 s
  EXPECT_EQ(tell(false), 0.0);
  EXPECT_EQ(tell(false), 0.0);
  EXPECT_EQ(tell(true), 0.5) << "a stimulation that is set once holds";
  rig.Set("inhibition_timeout", "3600");
  for (int i = 0; i < 30; ++i) EXPECT_EQ(tell(false), 0.5);
}

// Two that inhibit each other make each other's signals of them: what they were measured by never renews.
TEST(BehaviourTest, ASignalThatGoesRoundDoesNotGrowOldAsLongAsItIsSpoken) {
  ModuleRig<Told> rig;
  rig.Set("stimulation_mode", "enabled");
  ASSERT_TRUE(rig.Prepare());
  auto& others = rig.runtime.Create<Group>(rig.runtime.root(), "others");
  Output<Activity> inhibitor(others, "inhibitor");
  ASSERT_TRUE(Port::Connect(inhibitor, rig.module.inhibition(0)));
  const Time measured = rig.now();
  for (int i = 0; i < 30; ++i) {
    inhibitor.Publish(Activity(0.25), measured);
    rig.RunCycle();
    EXPECT_EQ(rig.Last(rig.module.activity).value(), 0.75) << i;
  }
  rig.module.inhibition(0).DisconnectAll();
}

TEST(BehaviourTest, AnInhibitorThatHasNeverSpokenInhibits) {
  ModuleRig<Told> rig;
  rig.Set("stimulation_mode", "enabled");
  ASSERT_TRUE(rig.Prepare());
  auto& others = rig.runtime.Create<Group>(rig.runtime.root(), "others");
  Output<Activity> inhibitor(others, "inhibitor");
  ASSERT_TRUE(Port::Connect(inhibitor, rig.module.inhibition(0)));
  for (int i = 0; i < 12; ++i) {
    rig.RunCycle();
    EXPECT_EQ(rig.Last(rig.module.activity).value(), i < 11 ? 1.0 : 0.0) << "it may have just begun, for 0.5 s";
  }
  inhibitor.Publish(Activity(0.25));
  rig.RunCycle();
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.75)));
  rig.module.inhibition(0).DisconnectAll();
}

TEST(BehaviourTest, WhoNeverCouldTellIsNotContent) {
  ModuleRig<Told> rig;
  rig.Feed("stimulation", Stimulation(0.5));
  rig.module.can_tell = false;
  rig.RunCycle();
  EXPECT_THAT(rig.module.activity, HasPublished(Activity(0.0)));
  EXPECT_THAT(rig.module.target_rating, HasPublished(TargetRating(1.0)));
}

TEST(BehaviourTest, AllocatesNothingInItsCycles) {
  ModuleRig<Told> rig;
  rig.Set("inhibitions", "3");
  rig.Feed("stimulation", Stimulation(0.5));
  rig.Feed("inhibition3", Inhibition(0.25));
  rig.RunCycles(10);
  EXPECT_THAT(rig, KeepsRealTime(100));
  rig.module.can_tell = false;
  EXPECT_THAT(rig, KeepsRealTime(100));
}

}  // namespace
}  // namespace runnel

// Ports that drive, while something farther up does not run that nobody on the way would notice.

#include "tests/plugins/supervision/driven_over.h"
#include "tests/plugins/supervision/notices.h"

namespace runnel::supervised {
namespace {

TEST_F(DrivenOver, APortHasItsSafeValueWhileWhatComesBeforeIsPaused) {
  MustSucceed(robot.supervisor.SetPaused("/laser", true));
  RunOn();
  EXPECT_EQ(robot.seen, -7);
  EXPECT_THAT(robot.Messages(), ElementsAre("has its safe value: /laser is paused"));
  MustSucceed(robot.supervisor.SetPaused("/laser", false));
  RunOn();
  EXPECT_EQ(robot.seen, 1);
}

TEST_F(DrivenOver, APortHasItsSafeValueWhenWhatComesBeforeIsGone) {
  MustSucceed(Port::Disconnect(robot.laser.out, passing.in));
  RunOn();
  EXPECT_EQ(robot.seen, -7);
  EXPECT_THAT(robot.Messages(), ElementsAre("has its safe value: nothing is connected to /passing/input/in any more"));
  MustSucceed(Port::Connect(robot.infrared.out, passing.in));
  RunOn();
  EXPECT_EQ(robot.seen, 2);
}

// As what is offered over a network is read.
TEST_F(DrivenOver, SoHasWhatDrivesInAnotherApplication) {
  MustSucceed(Port::Disconnect(passing.out, robot.reader.in));
  struct Beside final : FrameworkElement {
    explicit Beside(FrameworkElement& root) : FrameworkElement(Placement{root, "network", false}) {}
  } beside(robot.runtime.root());
  Input<double> sent(beside, "sent");
  MustSucceed(sent.SetDriving(true, {TypeOf<double>(), std::make_shared<double>(-7)}, {}, DrivingKind::kEffort));
  MustSucceed(Port::Connect(passing.out, sent));
  RunOn();
  EXPECT_EQ(sent.Get(), 1);
  MustSucceed(robot.supervisor.SetPaused("/laser", true));
  RunOn();
  EXPECT_EQ(sent.Get(), -7);
  const auto notices = test::NoticesOf(robot.supervisor);
  ASSERT_THAT(notices, SizeIs(1));
  EXPECT_EQ(notices[0].path, "/passing/output/out");
  MustSucceed(robot.supervisor.SetPaused("/laser", false));
  RunOn();
  EXPECT_EQ(sent.Get(), 1);
}

// What moves here by what is sent has another safe value, and is held itself.
TEST_F(DrivenOver, SoHasWhatDrivesElsewhereBesideWhatDrivesHereByAnotherSafeValue) {
  struct Beside final : FrameworkElement {
    explicit Beside(FrameworkElement& root) : FrameworkElement(Placement{root, "network", false}) {}
  } beside(robot.runtime.root());
  Input<double> sent(beside, "sent");
  MustSucceed(sent.SetDriving(true, {TypeOf<double>(), std::make_shared<double>(0)}, {}, DrivingKind::kEffort));
  MustSucceed(Port::Connect(passing.out, sent));
  RunOn();
  EXPECT_EQ(sent.Get(), 1);
  MustSucceed(robot.supervisor.SetPaused("/laser", true));
  RunOn();
  EXPECT_EQ(sent.Get(), 0);
  EXPECT_EQ(robot.seen, -7);
  MustSucceed(robot.supervisor.SetPaused("/laser", false));
  RunOn();
  EXPECT_EQ(sent.Get(), 1);
  EXPECT_EQ(robot.seen, 1);
}

/// Puts out what it has read last as new in each cycle; its input says whether it looks how old that is.
template <Ageing kAgeing>
struct Repeating final : Module {
  using Module::Module;
  Input<double> in{this, "in", {.ageing = kAgeing}};
  Output<double> out{this, "out"};
  void Update() override {
    if (in.Peek()) out.Publish(in.Get());
  }
};

/// Something moves by what comes over `on_the_way` to a port with a time-out.
template <Ageing kAgeing>
struct BaseOver {
  BaseOver(Robot& robot, Port& source) {
    auto& on_the_way = robot.runtime.Create<Repeating<kAgeing>>(robot.runtime.root(), "on_the_way");
    base = &robot.runtime.Create<Base>(robot.runtime.root(), "base");
    MustSucceed(Port::Connect(source, on_the_way.in));
    MustSucceed(Port::Connect(on_the_way.out, base->in));
    MustSucceed(robot.runtime.MakeReady(robot.runtime.root()));
  }
  struct Base final : Module {
    using Module::Module;
    Input<double> in{this,
                     "in",
                     {.drives = true,
                      .command = DrivingKind::kEffort,
                      .safe_value = {TypeOf<double>(), std::make_shared<double>(-7)},
                      .ageing = Ageing::kTimesOut}};
    double seen = 0;
    void Update() override { seen = in.Get(); }
  };
  [[nodiscard]] double seen() const { return base->seen; }

  Base* base = nullptr;
};

// By its own time-out it does not notice that, as what it gets is never old.
TEST_F(DrivenOver, APortWithATimeOutHasItsSafeValueWhileWhatIsPutOutAsNewIsOfAModuleAtRest) {
  const BaseOver<Ageing::kUnspecified> over(robot, robot.laser.out);
  RunOn();
  EXPECT_EQ(over.seen(), 1);
  MustSucceed(robot.supervisor.SetPaused("/laser", true));
  RunOn();
  EXPECT_EQ(over.seen(), -7);
  MustSucceed(robot.supervisor.SetPaused("/laser", false));
  RunOn();
  EXPECT_EQ(over.seen(), 1);
  robot.laser_throws = true;
  RunOn();
  EXPECT_EQ(over.seen(), -7);
}

TEST_F(DrivenOver, NorIsThatNoticedByWhoLooksOnTheWayHowOldItIs) {
  const BaseOver<Ageing::kTimesOut> over(robot, passing.out);
  RunOn();
  EXPECT_EQ(over.seen(), 1);
  MustSucceed(robot.supervisor.SetPaused("/laser", true));
  RunOn();
  EXPECT_EQ(over.seen(), -7);
}

// As a stimulation, which is said once and looks at no age.
TEST_F(DrivenOver, SoItHasWhileWhoHasSaidAWishDoesNotRun) {
  struct Wishing final : Module {
    using Module::Module;
    Input<bool> wish{this, "wish", {.ageing = Ageing::kWhileSourceRuns}};
    Input<double> goal{this, "goal", {.ageing = Ageing::kSetOnce}};
    Output<double> out{this, "out"};
    void Update() override { out.Publish(wish.Peek() ? 4 : 0); }
  };
  auto& wishing = robot.runtime.Create<Wishing>(robot.runtime.root(), "wishing");
  MustSucceed(Port::Disconnect(passing.out, robot.reader.in));
  MustSucceed(Port::Connect(wishing.out, robot.reader.in));
  MustSucceed(Port::Connect(robot.infrared.out, wishing.goal));
  MustSucceed(Port::Connect(dead_man.out, wishing.wish));
  MustSucceed(robot.runtime.MakeReady(robot.runtime.root()));
  RunOn();
  EXPECT_EQ(robot.seen, 4);
  dead_man.is_held = false;  // it has been said
  MustSucceed(robot.supervisor.SetPaused("/infrared", true));
  RunOn();
  EXPECT_EQ(robot.seen, 4) << "a goal holds until there is another";
  MustSucceed(robot.supervisor.SetPaused("/dead_man", true));
  RunOn();
  EXPECT_EQ(robot.seen, -7);
}

// As over a mux: another one may be selected there, and of this one the stamp tells.
TEST_F(DrivenOver, WhatPassesWithItsStampIsTheBusinessOfThePortsTimeOut) {
  const BaseOver<Ageing::kPassedOn> over(robot, robot.laser.out);
  MustSucceed(robot.supervisor.SetPaused("/laser", true));
  RunOn();
  EXPECT_EQ(over.seen(), 1);
}

TEST_F(DrivenOver, ASourceThatARuleHasSwitchedAwayCountsAgainOnceItHasPublished) {
  MustSucceed(Port::Disconnect(passing.out, robot.reader.in));
  MustSucceed(Port::Connect(robot.laser.out, robot.reader.in));
  MustSucceed(robot.supervisor.Add(
      SupervisionRule{.when = SupervisionRule::When::kPaused,
                      .of = "/laser",
                      .reaction = {.changes = Switch(robot.reader.in, robot.laser.out, robot.infrared.out)},
                      .otherwise = {.changes = Switch(robot.reader.in, robot.infrared.out, robot.laser.out)}}));
  MustSucceed(robot.supervisor.SetPaused("/laser", true));
  robot.laser_works = false;
  RunOn();
  EXPECT_EQ(robot.seen, 2);
  MustSucceed(robot.supervisor.SetPaused("/laser", false));
  EXPECT_EQ(robot.reader.in.Get(), -7) << "at once";
  RunOn();
  EXPECT_EQ(robot.seen, -7) << "it has said nothing yet";
  robot.laser_works = true;
  RunOn();
  EXPECT_EQ(robot.seen, 1);
}

TEST_F(DrivenOver, SoDoesOneThatNobodyReadWhenItWasAtRest) {
  MustSucceed(robot.supervisor.SetPaused("/infrared", true));
  RunOn();
  robot.infrared.action = [](Doing&) {};
  MustSucceed(robot.supervisor.SetPaused("/infrared", false));
  RunOn();
  EXPECT_EQ(robot.seen, 1);
  MustSucceed(Port::Disconnect(passing.out, robot.reader.in));
  MustSucceed(Port::Connect(robot.infrared.out, robot.reader.in));
  RunOn();
  EXPECT_EQ(robot.seen, -7);
  robot.infrared.action = [](Doing& module) { module.out.Publish(2); };
  RunOn();
  EXPECT_EQ(robot.seen, 2);
}

TEST_F(DrivenOver, WhatLooksHowOldItIsGoesOn) {
  struct Looking final : Module {
    using Module::Module;
    Input<double> in{this, "in", {.ageing = Ageing::kTimesOut}};
    Output<double> out{this, "out"};
    void Update() override { out.Publish(3); }
  };
  auto& ageing = robot.runtime.Create<Looking>(robot.runtime.root(), "ageing");
  MustSucceed(Port::Disconnect(passing.out, robot.reader.in));
  MustSucceed(Port::Connect(robot.laser.out, ageing.in));
  MustSucceed(Port::Connect(ageing.out, robot.reader.in));
  MustSucceed(robot.runtime.MakeReady(robot.runtime.root()));
  RunOn();
  MustSucceed(robot.supervisor.SetPaused("/laser", true));
  RunOn();
  EXPECT_EQ(robot.seen, 3);
  MustSucceed(robot.supervisor.SetPaused("/ageing", true));
  RunOn();
  EXPECT_EQ(robot.seen, -7);
}

TEST_F(DrivenOver, APortHasItsSafeValueWhileWhatSetsAParameterOnTheWayIsPausedOrGone) {
  HeldOpen(*passing.open.Feed());
  MustSucceed(robot.supervisor.SetPaused("/dead_man", true));
  RunOn();
  EXPECT_EQ(robot.seen, -7);
  dead_man.is_held = false;  // it says nothing any more
  MustSucceed(robot.supervisor.SetPaused("/dead_man", false));
  RunOn();
  EXPECT_EQ(robot.seen, -7) << "what it said before the pause does not count";
  dead_man.is_held = true;
  RunOn();
  EXPECT_EQ(robot.seen, 1);
  (void)robot.Messages();
  MustSucceed(Port::Disconnect(dead_man.out, *passing.open.Feed()));
  RunOn();
  EXPECT_EQ(robot.seen, -7);
  EXPECT_THAT(robot.Messages(), ElementsAre("has its safe value: nothing sets /passing/parameter/open any more"));
  MustSucceed(passing.open.SetFromText("true"));  // what a person says counts
  RunOn();
  EXPECT_EQ(robot.seen, 1);
}

TEST_F(DrivenOver, AReplacementIsNoPersonWhoHasSetTheParameter) {
  MustSucceed(robot.modules.Add(
      {"test/passing", "passes on", "test", [](const Placement& at) { return std::make_unique<Passing>(at); }}));
  HeldOpen(*passing.open.Feed());
  MustSucceed(Port::Disconnect(dead_man.out, *passing.open.Feed()));
  RunOn();
  EXPECT_EQ(robot.seen, -7);
  const auto swapped = robot.editor.Apply({ReplaceModule{.path = "/passing", .type = "test/passing"}});
  ASSERT_TRUE(swapped) << swapped.diagnostics.ToString();
  RunOn();
  EXPECT_EQ(robot.seen, -7);
}

// As of a bool that passes a merge, before it gets to the gate.
TEST_F(DrivenOver, WhatSetsAParameterOverAnotherModuleCountsToo) {
  struct PassingBool final : Module {
    using Module::Module;
    Input<bool> in{this, "in"};
    Output<bool> out{this, "out"};
    void Update() override {
      if (const auto value = in.Read(); value && value.is_new()) out.Publish(*value);
    }
  };
  auto& merge = robot.runtime.Create<PassingBool>(robot.runtime.root(), "merge");
  MustSucceed(Port::Connect(merge.out, *passing.open.Feed()));
  HeldOpen(merge.in);
  MustSucceed(robot.supervisor.SetPaused("/dead_man", true));
  RunOn();
  EXPECT_EQ(robot.seen, -7);
}

TEST_F(DrivenOver, SoDoesWhatSetsAParameterOfWhatDrivesItself) {
  auto& gate = robot.runtime.Create<Passing>(robot.runtime.root(), "gate");
  MustSucceed(Port::Connect(robot.laser.out, gate.in));
  MustSucceed(gate.in.SetDriving(true, {TypeOf<double>(), std::make_shared<double>(-7)}, {}, DrivingKind::kEffort));
  HeldOpen(*gate.open.Feed());
  MustSucceed(robot.supervisor.SetPaused("/dead_man", true));
  RunOn();
  EXPECT_EQ(gate.in.Get(), -7);
}

// Another input of the same module says nothing of it.
TEST_F(DrivenOver, WhatCameByAnInputThatIsCutOffCountsNoMore) {
  struct Merge final : Module {
    using Module::Module;
    Input<double> first{this, "first"}, second{this, "second"};
    Output<double> out{this, "out"};
    void Update() override {
      for (auto* each : {&first, &second}) {
        if (const auto value = each->Read(); value && value.is_new()) out.Publish(*value);
      }
    }
  };
  auto& merge = robot.runtime.Create<Merge>(robot.runtime.root(), "merge");
  auto& quiet = robot.runtime.Create<Doing>(robot.runtime.root(), "quiet");
  MustSucceed(Port::Disconnect(passing.out, robot.reader.in));
  MustSucceed(Port::Connect(passing.out, merge.first));
  MustSucceed(Port::Connect(quiet.out, merge.second));
  MustSucceed(Port::Connect(merge.out, robot.reader.in));
  MustSucceed(robot.runtime.MakeReady(robot.runtime.root()));
  RunOn();
  EXPECT_EQ(robot.seen, 1);
  MustSucceed(Port::Disconnect(passing.out, merge.first));
  RunOn();
  EXPECT_EQ(robot.seen, -7);
  quiet.action = [](Doing& module) { module.out.Publish(3); };
  RunOn();
  EXPECT_EQ(robot.seen, 3);
}

// One way to it looks how old it is, and the other one does not.
TEST_F(DrivenOver, WhatComesByTwoWaysCountsByTheOneThatDoesNotTimeOut) {
  struct Two final : Module {
    using Module::Module;
    Input<double> ages{this, "ages", {.ageing = runnel::Ageing::kTimesOut}}, passes{this, "passes"};
    Output<double> out{this, "out"};
    void Update() override {
      if (const auto value = passes.Read(); value && value.is_new()) out.Publish(*value);
    }
  };
  auto& two = robot.runtime.Create<Two>(robot.runtime.root(), "two");
  MustSucceed(Port::Disconnect(passing.out, robot.reader.in));
  MustSucceed(Port::Connect(passing.out, two.ages));
  MustSucceed(Port::Connect(passing.out, two.passes));
  MustSucceed(Port::Connect(two.out, robot.reader.in));
  MustSucceed(robot.runtime.MakeReady(robot.runtime.root()));
  RunOn();
  EXPECT_EQ(robot.seen, 1);
  MustSucceed(robot.supervisor.SetPaused("/laser", true));
  RunOn();
  EXPECT_EQ(robot.seen, -7);
}

}  // namespace
}  // namespace runnel::supervised

// Ports that drive, while something farther up does not run that nobody on the way would notice.

#include "plugins/parameters/parameter.h"
#include "tests/plugins/supervision/supervised_robot.h"

namespace runnel::supervised {
namespace {

/// Passes on what is new, as long as `open` says so; nothing here looks how old it is.
class Passing final : public Module {
 public:
  using Module::Module;
  Input<double> in{this, "in"};
  Output<double> out{this, "out"};
  Parameter<bool> open{this, "open", {.default_value = true}};

 private:
  void Update() override {
    if (const auto value = in.Read(); value && value.is_new() && open.Get()) out.Publish(*value);
  }
};

/// Something moves by what comes over the module.
class DrivenOver : public Driven {
 protected:
  DrivenOver() {
    MustSucceed(Port::Disconnect(robot.laser.out, robot.reader.in));
    MustSucceed(Port::Connect(robot.laser.out, passing.in));
    MustSucceed(Port::Connect(passing.out, robot.reader.in));
    MustSucceed(robot.runtime.MakeReady(robot.runtime.root()));
    RunOn();
    EXPECT_EQ(robot.seen, 1);
    (void)robot.Messages();
  }
  /// A switch that somebody holds, connected to the input.
  struct DeadMan final : Module {
    using Module::Module;
    Output<bool> out{this, "out"};
    bool is_held = true;
    void Update() override {
      if (is_held) out.Publish(true);
    }
  };
  void HeldOpen(Port& input) {
    MustSucceed(Port::Connect(dead_man.out, input));
    MustSucceed(robot.runtime.MakeReady(robot.runtime.root()));
    RunOn();
    EXPECT_EQ(robot.seen, 1);
    (void)robot.Messages();
  }
  DeadMan& dead_man = robot.runtime.Create<DeadMan>(robot.runtime.root(), "dead_man");
  Passing& passing = robot.runtime.Create<Passing>(robot.runtime.root(), "passing");
};

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
  MustSucceed(sent.SetDriving(true, {TypeOf<double>(), std::make_shared<double>(-7)}));
  MustSucceed(Port::Connect(passing.out, sent));
  RunOn();
  EXPECT_EQ(sent.Get(), 1);
  MustSucceed(robot.supervisor.SetPaused("/laser", true));
  RunOn();
  EXPECT_EQ(sent.Get(), -7);
  const auto notices = robot.supervisor.TakeNotices();
  ASSERT_THAT(notices, SizeIs(1));
  EXPECT_EQ(notices[0].path, "/passing/output/out");
  MustSucceed(robot.supervisor.SetPaused("/laser", false));
  RunOn();
  EXPECT_EQ(sent.Get(), 1);
}

TEST_F(DrivenOver, WhatLooksHowOldItIsGoesOn) {
  struct Ageing final : Module {
    using Module::Module;
    Input<double> in{this, "in", {.ageing = runnel::Ageing::kTimesOut}};
    Output<double> out{this, "out"};
    void Update() override { out.Publish(3); }
  };
  auto& ageing = robot.runtime.Create<Ageing>(robot.runtime.root(), "ageing");
  MustSucceed(Port::Disconnect(passing.out, robot.reader.in));
  MustSucceed(Port::Connect(passing.out, ageing.in));
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
  MustSucceed(robot.modules.Add({"test/passing", "passes on", "test", [](const Placement& at) { return std::make_unique<Passing>(at); }}));
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
  MustSucceed(gate.in.SetDriving(true, {TypeOf<double>(), std::make_shared<double>(-7)}));
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

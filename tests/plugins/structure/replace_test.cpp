#include "core/module/kept_state.h"
#include "tests/plugins/structure/editor_fixture.h"
#include "tests/support/schedule_order.h"

namespace runnel::test {

struct Place {
  double x = 0;
  double heading = 0;
};
inline void Describe(TypeBuilder<Place>& type) {
  type.Name("test::Place").Field("x", &Place::x, {.unit = "m"}).Field("heading", &Place::heading, {.unit = "rad"});
}

namespace {

class ReplaceTest : public EditorTest {
 protected:
  ReplaceTest() {
    Must({CreateModule{"/app/counter", "test/counter", {{"step", "2"}}}, CreateModule{"/app/sink", "test/sink"},
          ConnectPorts{"/app/counter/out", "/app/sink/in", {.queue = 100, .on_full = OnFull::kRefuse}},
          ConnectPorts{"/app/sink/sum", "/app/sink/side"}});
  }
};

TEST_F(ReplaceTest, TheNewModuleGoesOnWhereTheOldOneStopped) {
  Steps(3);
  Must({ReplaceModule{"/app/counter", "test/other_counter"}});
  Steps(3);
  EXPECT_THAT(At<Sink>("/app/sink").taken, ElementsAre(2, 4, 6, 8, 10, 12));
  auto& counter = At<OtherCounter>("/app/counter");
  EXPECT_EQ(counter.step.Get(), 2) << "a value of the same name";
  EXPECT_EQ(counter.own.Get(), 7);
}

/// Something of it goes on beside its cycles until it is told to come to an end, as codels of a component do.
class Winding final : public Counter {
 public:
  explicit Winding(const Placement& placement) : Counter(placement) {
    Annotate(std::make_unique<BeforeHandOver>([this] {
      if (cannot_end) throw std::runtime_error("one of its helpers does not come back");
      out.Publish(count.value += 100);
      return std::shared_ptr<void>(nullptr, [this](void*) { ties_at_end = out.outgoing().size(); });
    }));
  }
  bool cannot_end = false;
  std::optional<std::size_t> ties_at_end;  // of the output, when its ports were where they are
};

TEST_F(ReplaceTest, WhatGoesOnBesideCyclesEndsBeforePortsAndStateAreHandedOver) {
  ASSERT_TRUE(modules.Add(TypeCalled<Winding>("test/winding")));
  Must({ReplaceModule{"/app/counter", "test/winding"}});
  EXPECT_THAT(At<Winding>("/app/counter").ties_at_end, testing::Optional(testing::Gt(0u)));
  Steps(2);
  At<Winding>("/app/counter").cannot_end = true;
  EXPECT_THAT(Refusal({ReplaceModule{"/app/counter", "test/counter"}}), HasSubstr("does not come back"));
  Steps(1);
  At<Winding>("/app/counter").cannot_end = false;
  Must({ReplaceModule{"/app/counter", "test/counter"}});
  Steps(1);
  EXPECT_THAT(At<Sink>("/app/sink").taken, ElementsAre(2, 4, 6, 106, 108));
}

TEST_F(ReplaceTest, WhatGoesOnBesideCyclesLeavesPortsAloneWhileTheyComeBack) {
  ASSERT_TRUE(modules.Add(TypeCalled<Winding>("test/winding")));
  Must({ReplaceModule{"/app/counter", "test/winding"}});
  auto& winding = At<Winding>("/app/counter");
  Must({ReplaceModule{"/app/counter", "test/faulty", {{"good_cycles", "1"}}}});
  EXPECT_EQ(winding.ties_at_end, 0u);
  Steps(2);
  ASSERT_EQ(&At<Module>("/app/counter"), &winding);
  EXPECT_THAT(winding.ties_at_end, testing::Optional(testing::Gt(0u)));
}

TEST_F(ReplaceTest, SettingsComeLast) {
  Must({ReplaceModule{"/app/counter", "test/other_counter", {{"step", "5"}, {"own", "8"}}}});
  EXPECT_EQ(At<OtherCounter>("/app/counter").step.Get(), 5);
  EXPECT_EQ(At<OtherCounter>("/app/counter").own.Get(), 8);
}

TEST_F(ReplaceTest, WhatTheSameChangeSetHasSetBeforeIsTakenOver) {
  Must({SetParameter{"/app/counter/parameter/step", "1"}, AssignToThread{"/app/counter", "slow"},
        ReplaceModule{"/app/counter", "test/other_counter", {{"own", "9"}}},
        SetParameter{"/app/counter/parameter/own", "10"}});
  EXPECT_EQ(At<OtherCounter>("/app/counter").step.Get(), 1) << "the default value, set on purpose";
  EXPECT_EQ(At<OtherCounter>("/app/counter").own.Get(), 10);
  EXPECT_THAT(test::OrderOf(scheduler, At<ThreadContainer>("/threads/slow")), SizeIs(1));
}

TEST_F(ReplaceTest, AReaderIsReplacedWithoutLosingOrRepeatingWhatWaits) {
  Steps(2);
  At<Counter>("/app/counter").out.Publish(77);  // waits while the sink is exchanged
  Must({ReplaceModule{"/app/sink", "test/sink"}});
  Steps(1);
  EXPECT_THAT(At<Sink>("/app/sink").taken, ElementsAre(2, 4, 77, 6));
  EXPECT_THAT(At<Sink>("/app/sink").side.Sources(), ElementsAre(&At<Sink>("/app/sink").sum));
}

TEST_F(ReplaceTest, ItTakesTheOldPlaceAmongItsSiblingsAndItsThread) {
  Must({AssignToThread{"/app/counter", "slow"}});
  Must({ReplaceModule{"/app/counter", "test/other_counter"}});
  EXPECT_EQ(At<Group>("/app").children().front()->name(), "counter");
  const auto order = test::OrderOf(scheduler, At<ThreadContainer>("/threads/slow"));
  ASSERT_THAT(order, SizeIs(1));
  EXPECT_EQ(order[0].path, "/app/counter");
}

TEST_F(ReplaceTest, WhatDoesNotFitIsToldAndChangesNothing) {
  EXPECT_THAT(Refusal({ReplaceModule{"/app/counter", "test/text_counter"}}), HasSubstr("carries"));
  EXPECT_THAT(Refusal({ReplaceModule{"/app/counter", "test/silent"}}),
              HasSubstr("has no port 'out', which is connected"));
  EXPECT_THAT(Refusal({ReplaceModule{"/app/counter", "test/never_made"}}), HasSubstr("cannot be made"));
  EXPECT_THAT(Refusal({ReplaceModule{"/app/counter", "test/never_ready"}}), HasSubstr("has no device"));
  EXPECT_THAT(Refusal({ReplaceModule{"/app/conter", "test/counter"}}), HasSubstr("'counter'?"));
  Steps(2);
  EXPECT_THAT(At<Sink>("/app/sink").taken, ElementsAre(2, 4));
}

TEST_F(ReplaceTest, TwoOfOneConnectionCanBeReplacedTogether) {
  Steps(1);
  Must({ReplaceModule{"/app/sink", "test/sink"}, ReplaceModule{"/app/counter", "test/other_counter"},
        ReplaceModule{"/app/counter", "test/counter"}});
  Steps(2);
  EXPECT_EQ(FindModuleType(At<Module>("/app/counter")), "test/counter");
  EXPECT_THAT(At<Sink>("/app/sink").taken, ElementsAre(2, 4, 6));
}

TEST_F(ReplaceTest, WhatThrowsInItsFirstCyclesMakesRoomForTheOldOne) {
  Steps(2);
  Must({ReplaceModule{"/app/counter", "test/faulty", {{"good_cycles", "3"}}}});
  EXPECT_EQ(editor.on_probation(), 1u);
  Steps(4);
  EXPECT_EQ(FindModuleType(At<Module>("/app/counter")), "test/counter");
  const auto faults = scheduler.TakeFaults();
  ASSERT_THAT(faults, SizeIs(1));
  EXPECT_TRUE(faults[0].is_mended);
  EXPECT_THAT(faults[0].message, HasSubstr("is faulty; the module before (test/counter) is back in its place"));
  Steps(2);
  EXPECT_THAT(At<Sink>("/app/sink").taken, ElementsAre(2, 4, -1, -1, -1, 6, 8));
  EXPECT_EQ(editor.on_probation(), 0u);
}

TEST_F(ReplaceTest, NoRuleIsAppliedToAFaultThatWasMended) {
  scheduler.AddFaultRule({.of = "/app"});
  Must({ReplaceModule{"/app/counter", "test/faulty"}});
  Steps(2);
  EXPECT_FALSE(scheduler.stop_requested());
  Must({ReplaceModule{"/app/counter", "test/faulty", {}, 0}});
  scheduler.Step();
  EXPECT_TRUE(scheduler.stop_requested()) << "not on probation";
}

TEST_F(ReplaceTest, WhoHasProvedItselfStaysEvenIfItThrowsLater) {
  Must({ReplaceModule{"/app/counter", "test/faulty", {{"good_cycles", "8"}}, 3}});
  Steps(6);
  editor.Tend();
  EXPECT_EQ(editor.on_probation(), 0u);
  Steps(4);
  EXPECT_EQ(FindModuleType(At<Module>("/app/counter")), "test/faulty");
  EXPECT_THAT(scheduler.TakeFaults(), SizeIs(1));
}

TEST_F(ReplaceTest, AFaultyModuleIsMadeAnewByItsOwnType) {
  Must({ReplaceModule{"/app/counter", "test/faulty", {}, 0}});
  Steps(2);
  EXPECT_THAT(scheduler.TakeFaults(), SizeIs(1));
  Must({ReplaceModule{"/app/counter", "test/faulty", {{"good_cycles", "100"}}, 0}});
  Steps(2);
  EXPECT_THAT(scheduler.TakeFaults(), IsEmpty());
  EXPECT_THAT(At<Sink>("/app/sink").taken, ElementsAre(-1, -1));
}

TEST_F(ReplaceTest, TheOldOneComesBackAmongConnectionsThatHaveChangedMeanwhile) {
  Must({ReplaceModule{"/app/counter", "test/faulty", {{"good_cycles", "2"}}}});
  Steps(1);
  Must({DisconnectPorts{"/app/counter/out", "/app/sink/in"}, CreateModule{"/app/second", "test/sink"},
        ConnectPorts{"/app/counter/out", "/app/second/in", {.queue = 10}}});
  Steps(4);
  EXPECT_THAT(At<Sink>("/app/sink").taken, ElementsAre(-1));
  EXPECT_THAT(At<Sink>("/app/second").taken, ElementsAre(-1, -1, 2, 4));
}

TEST_F(ReplaceTest, ASuccessorOnProbationCanItselfBeReplacedOrDeleted) {
  Must({ReplaceModule{"/app/counter", "test/faulty", {{"good_cycles", "50"}}}});
  Must({ReplaceModule{"/app/counter", "test/counter"}});
  Steps(3);
  Must({DeleteElement{"/app/counter"}});
  Steps(1);
  editor.Tend();
  EXPECT_EQ(editor.on_probation(), 0u);
  EXPECT_FALSE(Exists("/app/counter"));
}

struct Places final : Module {
  using Module::Module;
  Output<Place> place{this, "place"};
  void Update() override {}
};
template <bool kHasUnit>
struct Turning final : Module {
  using Module::Module;
  Input<double> in{this, "in", {.unit = kHasUnit ? "deg" : ""}};
  void Update() override {}
};

// Of what each set connects and swaps itself, the part counts, too.
TEST_F(ReplaceTest, APartIsConvertedAsBefore) {
  Register<Places>("test/places");
  Register<Turning<false>>("test/turning");
  Register<Turning<true>>("test/degrees");
  const ConnectPorts connect{"/app/s/place.heading", "/app/m/in"};
  Must({CreateModule{"/app/s", "test/places"}, CreateModule{"/app/m", "test/turning"}, connect});
  const DisconnectPorts disconnect{"/app/s/place", "/app/m/in"};
  const ReplaceModule source{"/app/s", "test/places"}, sink{"/app/m", "test/degrees"};
  for (const ChangeSet& each :
       {ChangeSet{sink}, ChangeSet{source, sink}, ChangeSet{sink, source}, ChangeSet{source, source, sink},
        ChangeSet{disconnect, connect, sink}, ChangeSet{disconnect, connect, source, sink}}) {
    EXPECT_THAT(Refusal(each), HasSubstr("the values between /app/s/output/place and /app/m/input/in would be "
                                         "converted otherwise; disconnect them first"));
  }
  Must({source, {ReplaceModule{"/app/m", "test/turning"}}, source});
  Must({disconnect, source, sink, connect});
  At<Places>("/app/s").place.Publish({.heading = 1});
  EXPECT_NEAR(At<Turning<true>>("/app/m").in.Get(), 57.3, 0.1);
}

}  // namespace
}  // namespace runnel::test

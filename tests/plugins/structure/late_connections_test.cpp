// Connections that wait for their ends, and change sets.

#include "core/paths/late_connections.h"

#include "core/module/kept_state.h"
#include "core/paths/distant_ports.h"
#include "tests/plugins/structure/adder_fixture.h"

namespace runnel::test {
namespace {

struct SilentApplication final : DistantPorts {
  Port* Find(std::string_view) const override { return nullptr; }
  DistantType TypeOf(std::string_view) const override { return {.why_not = "it does not answer"}; }
  Result<Port*> Make(std::string_view, const Port&, const ConnectOptions&) override { return nullptr; }
};
/// Of what another application is to send.
struct Awaiting : StaticParameterTest {
  Awaiting() {
    runtime.root().Annotate<DistantPorts>(std::make_unique<SilentApplication>());
    Must({DisconnectPorts{"/app/counter/out", "/app/adder/in3"}});
    const std::lock_guard lock(runtime.structure_mutex());
    EXPECT_TRUE(LateConnections::Of(runtime).Add("//other/m/x", "/app/adder/in3", {}));
  }
  bool IsAwaited(const char* by = "/app/adder/in3") {
    const std::lock_guard lock(runtime.structure_mutex());
    return LateConnections::Of(runtime).Find("//other/m/x", by) != nullptr;
  }
};

TEST_F(Awaiting, WhatWaitsForAPortThatGoesIsToldAndComesBackWithUndo) {
  const ChangeOutcome outcome = history_.Apply({SetParameter{"/app/adder/inputs", "2"}});
  ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
  EXPECT_THAT(outcome.diagnostics.ToString(),
              HasSubstr("//other/m/x: is not waited for any more: the module made anew has no such port"));
  EXPECT_FALSE(IsAwaited());
  const ChangeOutcome back = history_.Undo();
  ASSERT_TRUE(back) << back.diagnostics.ToString();
  EXPECT_TRUE(IsAwaited());
}

// By what waits when the changes before are made.
TEST_F(Awaiting, WhatIsDisconnectedInTheSameSetWaitsNoMore) {
  const DisconnectPorts disconnect{"//other/m/x", "/app/adder/in3"};
  const ConnectPorts connect{"//other/m/x", "/app/adder/in3"};
  for (const Change& next :
       {Change(SetParameter{"/app/adder/inputs", "2"}),
        Change(ReplaceModule{"/app/adder", "test/adder", {{"inputs", "2"}}}), Change(DeleteElement{"/app/adder"})}) {
    const ChangeOutcome outcome = history_.Apply({disconnect, next});
    ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
    EXPECT_THAT(outcome.diagnostics.ToString(), testing::Not(HasSubstr("waited")));
    EXPECT_FALSE(IsAwaited());
    ASSERT_TRUE(history_.Undo());
    EXPECT_TRUE(IsAwaited());
  }
  Refusal({disconnect, disconnect});
  Must({disconnect, connect});
  EXPECT_TRUE(IsAwaited());
  EXPECT_THAT(Refusal({ReplaceModule{"/app/adder", "test/adder", {{"inputs", "2"}}}}),
              HasSubstr("has no port 'in3', which is connected"));
  Must({disconnect, connect, DeleteElement{"/app/adder"}});
  EXPECT_FALSE(IsAwaited());
  ASSERT_TRUE(
      editor.Apply({CreateModule{"/app/adder", "test/adder", {{"inputs", "3"}}}, connect, disconnect, connect}));
  EXPECT_TRUE(IsAwaited());
  for (const ChangeSet& each : {ChangeSet{disconnect, connect, SetParameter{"/app/adder/inputs", "2"}},
                                ChangeSet{disconnect, RenameElement{"/app/adder", "other"}}}) {
    const ChangeOutcome outcome = history_.Apply(each);
    ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
    EXPECT_FALSE(IsAwaited());
    ASSERT_TRUE(history_.Undo());
    EXPECT_TRUE(IsAwaited());
  }
}

// By whichever name the changes before have given it.
TEST_F(Awaiting, WhatIsRenamedInTheSameSetIsAwaitedByItsNewName) {
  const RenameElement rename{"/app/adder", "other"};
  EXPECT_THAT(Refusal({rename, ReplaceModule{"/app/other", "test/adder", {{"inputs", "2"}}}}),
              HasSubstr("has no port 'in3', which is connected"));
  ASSERT_TRUE(history_.Apply({rename, RenameElement{"/app/other", "third"}, RenameElement{"/app/third", "adder"},
                              RenameElement{"/app/adder", "last"}}));
  EXPECT_TRUE(IsAwaited("/app/last/in3"));
  ASSERT_TRUE(history_.Undo());
  EXPECT_TRUE(IsAwaited());
}

struct OfType final : Module {
  using Module::Module;
  StaticParameter<bool> is_text{this, "is_text"};
  std::optional<Input<int>> number;
  std::optional<Input<std::string>> text;
  Result<void> Construct() override {
    if (is_text.Get()) {
      text.emplace(this, "in");
    } else {
      number.emplace(this, "in");
    }
    return {};
  }
  void Update() override {}
};

struct Drives final : Module {
  using Module::Module;
  Input<int> in{this, "in", {.unit = "m/s", .drives = true}};
  void Update() override {}
};
struct MovesNothing final : Module {
  using Module::Module;
  Input<int> in{this, "in", {.unit = "km/h"}};
  void Update() override {}
};

// What comes would move it, and no STOP would hold it.
TEST_F(Awaiting, AnInputThatDrivesGivesItsPlaceToNoneThatDoesNot) {
  Register<Drives>("test/drives");
  Register<MovesNothing>("test/moves_nothing");
  Must({CreateModule{"/app/m", "test/drives"}});
  Must({ReplaceModule{"/app/m", "test/moves_nothing"}, ReplaceModule{"/app/m", "test/drives"}});
  Must({ConnectPorts{"//other/m/x", "/app/m/in"}});
  EXPECT_THAT(Refusal({ReplaceModule{"/app/m", "test/moves_nothing"}}),
              HasSubstr("is in km/h and cannot take over from"));
}

// It waits for whatever has the name.
TEST_F(Awaiting, AnInputOfAnotherTypeIsAwaitedLikewise) {
  Register<OfType>("test/of_type");
  const ConnectPorts connect{"//other/m/x", "/app/m/in"};
  ASSERT_TRUE(history_.Apply({CreateModule{"/app/m", "test/of_type"}, connect}));
  ASSERT_TRUE(IsAwaited("/app/m/in"));
  // Also where another connection has to be cut.
  ASSERT_TRUE(history_.Apply({ConnectPorts{"/app/counter/out", "/app/m/in"}}));
  ASSERT_TRUE(history_.Apply({SetParameter{"/app/m/is_text", "true"}}));
  EXPECT_TRUE(IsAwaited("/app/m/in"));
  const ChangeOutcome back = history_.Undo();
  EXPECT_TRUE(back) << back.diagnostics.ToString();
  EXPECT_TRUE(IsAwaited("/app/m/in"));
}

// While a change waits for others.
TEST_F(Awaiting, WhatHasBeenAddedMeanwhileIsSeen) {
  std::thread renaming;
  {
    const std::lock_guard lock(runtime.structure_mutex());
    renaming = std::thread([this] { Must({RenameElement{"/app/adder", "other"}}); });
    std::this_thread::sleep_for(20ms);
    EXPECT_TRUE(LateConnections::Of(runtime).Add("//other/m/y", "/app/adder/in2", {}));
  }
  renaming.join();
  const std::lock_guard lock(runtime.structure_mutex());
  EXPECT_NE(LateConnections::Of(runtime).Find("//other/m/y", "/app/other/in2"), nullptr);
}

struct WhenPresent : StaticParameterTest {
  WhenPresent() { Must({cut, ConnectPorts{"/app/counter/out", "/app/adder/in1", {.when_present = true}}}); }
  std::size_t CountNoted() {
    const std::lock_guard lock(runtime.structure_mutex());
    return LateConnections::Of(runtime).all().size();
  }
  const DisconnectPorts cut{"/app/counter/out", "/app/adder/in1"};
};

TEST_F(WhenPresent, WhatIsCutStaysCutWhereItsEndGoesInTheSameSet) {
  for (const Change& next : {Change(ReplaceModule{"/app/adder", "test/adder"}),
                             Change(RenameElement{"/app/adder", "other"}), Change(DeleteElement{"/app/counter"})}) {
    ASSERT_TRUE(history_.Apply({cut, next}));
    EXPECT_EQ(CountNoted(), 0U);
    ASSERT_TRUE(history_.Undo());
    EXPECT_THAT(At<Port>("/app/adder/input/in1").incoming(), SizeIs(1));
    EXPECT_EQ(CountNoted(), 1U);
  }
}

// Nobody has disconnected it.
TEST_F(WhenPresent, WhatAParameterCutsComesBackWithItsPort) {
  Must({DisconnectPorts{"/app/counter/out", "/app/adder/in3"},
        ConnectPorts{"/app/counter/out", "/app/adder/in3", {.when_present = true}}});
  Must({SetParameter{"/app/adder/inputs", "2"}});
  EXPECT_EQ(CountNoted(), 2U);
  Must({SetParameter{"/app/adder/inputs", "3"}});
  EXPECT_THAT(At<Port>("/app/adder/input/in3").incoming(), SizeIs(1));
}

TEST_F(WhenPresent, WhatGoesAndWhatIsRenamedMayBeInOneSet) {
  for (const ChangeSet& each : {ChangeSet{RenameElement{"/app/adder", "other"}, DeleteElement{"/app/counter"}},
                                ChangeSet{DeleteElement{"/app/counter"}, RenameElement{"/app/adder", "other"}}}) {
    const ChangeOutcome outcome = history_.Apply(each);
    ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
    EXPECT_EQ(CountNoted(), 1U);
    const ChangeOutcome back = history_.Undo();
    ASSERT_TRUE(back) << back.diagnostics.ToString();
    EXPECT_THAT(At<Port>("/app/adder/input/in1").incoming(), SizeIs(1));
    EXPECT_EQ(CountNoted(), 1U);
  }
}

struct NeverSettles final : Module {
  explicit NeverSettles(const Placement& placement) : Module(placement) {
    Annotate(std::make_unique<BeforeHandOver>(
        []() -> BeforeHandOver::Held { throw std::runtime_error("what is under way does not end"); }));
  }
  void Update() override {}
};

/// Both ends are there, and what the one carries now does not fit.
struct StandsAgainst : WhenPresent {
  StandsAgainst() {
    Register<NeverSettles>("test/never_settles");
    Must({DeleteElement{"/app/counter"}, CreateModule{"/app/counter", "test/text_counter"}});
    EXPECT_THAT(WhyItWaits(), HasSubstr("carries string"));
  }
  std::string WhyItWaits(const char* by = "/app/adder/in1") {
    const std::lock_guard lock(runtime.structure_mutex());
    const LateConnection* const found = LateConnections::Of(runtime).Find("/app/counter/out", by);
    return found == nullptr ? "it does not" : found->waits_for.value_or("");
  }
};

TEST_F(StandsAgainst, ItFollowsARenameAndComesBackWithUndo) {
  for (const auto& [change, by] : {std::pair(Change(RenameElement{"/app/adder", "other"}), "/app/other/in1"),
                                   std::pair(Change(cut), "/app/adder/in1")}) {
    const ChangeOutcome outcome = history_.Apply({change});
    ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
    EXPECT_EQ(CountNoted(), std::holds_alternative<RenameElement>(change) ? 1U : 0U);
    const std::string why = WhyItWaits(by);
    const ChangeOutcome back = history_.Undo();
    ASSERT_TRUE(back) << back.diagnostics.ToString();
    EXPECT_THAT(WhyItWaits(), HasSubstr("carries string"));
    ASSERT_TRUE(history_.Redo());
    EXPECT_EQ(WhyItWaits(by), why);
    ASSERT_TRUE(history_.Undo());
  }
  Must({DeleteElement{"/app/counter"}, CreateModule{"/app/counter", "test/counter"}});
  EXPECT_THAT(At<Port>("/app/adder/input/in1").incoming(), SizeIs(1));
}

// It is noted while an end is gone, and what the other end has become meanwhile stands against it.
TEST_F(WhenPresent, UndoOfADeletionLeavesItNotedWhereTheOtherEndDoesNotFitAnyMore) {
  Must({DisconnectPorts{"/app/counter/out", "/app/adder/in3"}});
  ASSERT_TRUE(history_.Apply({DeleteElement{"/app/adder"}}));
  Must({DeleteElement{"/app/counter"}, CreateModule{"/app/counter", "test/text_counter"}});
  const ChangeOutcome back = history_.Undo();
  ASSERT_TRUE(back) << back.diagnostics.ToString();
  EXPECT_EQ(CountNoted(), 1U);
  EXPECT_THAT(At<Port>("/app/adder/input/in1").incoming(), IsEmpty());
  Must({DeleteElement{"/app/counter"}, CreateModule{"/app/counter", "test/counter"}});
  EXPECT_THAT(At<Port>("/app/adder/input/in1").incoming(), SizeIs(1));
}

TEST_F(StandsAgainst, ItIsNotedAgainWhereASetFails) {
  Must({CreateModule{"/app/m", "test/never_settles"}});
  const std::string why = Refusal({cut, ReplaceModule{"/app/m", "test/never_settles"}});
  EXPECT_THAT(why, HasSubstr("what is under way does not end"));
  EXPECT_THAT(why, testing::Not(HasSubstr("lack of memory")));
  EXPECT_THAT(WhyItWaits(), HasSubstr("carries string"));
}

// A person is told at once.
TEST_F(StandsAgainst, WhoConnectsWhatDoesNotFitIsRefused) {
  Must({cut});
  EXPECT_THAT(Refusal({ConnectPorts{"/app/counter/out", "/app/adder/in1", {.when_present = true}}}),
              HasSubstr("carries string"));
  EXPECT_EQ(CountNoted(), 0U);
}

}  // namespace
}  // namespace runnel::test

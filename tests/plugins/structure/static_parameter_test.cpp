#include <deque>

#include "core/paths/distant_ports.h"
#include "core/paths/late_connections.h"
#include "plugins/structure/change_history.h"
#include "tests/plugins/structure/editor_fixture.h"

namespace runnel::test {
namespace {

/// As many inputs as its parameter says; publishes their sum, and how often it has done so.
class Adder final : public Module {
 public:
  explicit Adder(const Placement& placement) : Module(placement) { KeepState(count); }

  StaticParameter<std::uint32_t> inputs{this, "inputs", {.default_value = 2, .bounds = {1, 8}}};
  Parameter<int> offset{this, "offset"};
  std::deque<Input<int>> in;
  std::deque<Parameter<int>> weights;
  Output<int> sum{this, "sum"};
  Count count;
  int told = 0;

 private:
  Result<void> Construct() override {
    if (inputs.Get() == 7) return Error{.message = "seven is not to be had"};
    for (std::uint32_t i = 1; i <= inputs.Get(); ++i) {
      in.emplace_back(this, "in" + std::to_string(i));
      weights.emplace_back(this, "weight" + std::to_string(i), ParameterOptions<int>{.default_value = 1});
    }
    return {};
  }
  void OnParametersChanged() override { ++told; }
  void Update() override {
    int total = offset.Get();
    for (std::size_t i = 0; i < in.size(); ++i) total += weights[i].Get() * in[i].Get();
    ++count.value;
    sum.Publish(total);
  }
};

class StaticParameterTest : public EditorTest {
 protected:
  StaticParameterTest() {
    Register<Adder>("test/adder");
    Must({CreateModule{"/app/counter", "test/counter"},
          CreateModule{"/app/adder", "test/adder", {{"inputs", "3"}, {"offset", "100"}}},
          CreateModule{"/app/sink", "test/sink"}, ConnectPorts{"/app/counter/out", "/app/adder/in1"},
          ConnectPorts{"/app/counter/out", "/app/adder/in3", {.queue = 4}},
          ConnectPorts{"/app/adder/sum", "/app/sink/in", {.queue = 100}},
          ConnectPorts{"/app/adder/sum", "/app/sink/side"}});
  }
  Adder& adder() { return At<Adder>("/app/adder"); }
  ChangeHistory history_{editor};
};

TEST_F(StaticParameterTest, PortsFollowFromIt) {
  EXPECT_THAT(adder().in, SizeIs(3));
  Steps(2);
  EXPECT_EQ(At<Sink>("/app/sink").taken.back(), 100 + 2 * 2);
  EXPECT_THAT(Refusal({CreateModule{"/app/bad", "test/adder", {{"inputs", "7"}}}}),
              HasSubstr("/app/bad: seven is not to be had"));
}

TEST_F(StaticParameterTest, AChangeOfItKeepsWhatFits) {
  Steps(2);
  const ChangeOutcome outcome = history_.Apply({SetParameter{"/app/adder/inputs", "5"}});
  ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
  EXPECT_TRUE(outcome.diagnostics.warnings().empty());
  EXPECT_THAT(adder().in, SizeIs(5));
  Steps(1);
  EXPECT_EQ(adder().offset.Get(), 100);
  EXPECT_EQ(adder().count.value, 3) << "the state that it keeps";
  EXPECT_EQ(adder().told, 1) << "the new module is told of its parameters";
  EXPECT_THAT(At<Sink>("/app/sink").taken, ElementsAre(102, 104, 106));
  ASSERT_TRUE(history_.Undo());
  EXPECT_THAT(adder().in, SizeIs(3));
  Steps(1);
  EXPECT_THAT(At<Sink>("/app/sink").taken, ElementsAre(102, 104, 106, 108));
}

TEST_F(StaticParameterTest, WhatDoesNotFitIsCutAndComesBackWithUndo) {
  const std::string before = Structure();
  const ChangeOutcome outcome = history_.Apply({SetParameter{"/app/adder/inputs", "1"}});
  ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
  EXPECT_THAT(outcome.diagnostics.ToString(),
              HasSubstr("/app/counter/output/out: is not connected to /app/adder/input/in3 any more"));
  Steps(1);
  EXPECT_EQ(At<Sink>("/app/sink").taken.back(), 101);
  ASSERT_TRUE(history_.Undo());
  Steps(1);
  EXPECT_EQ(At<Sink>("/app/sink").taken.back(), 104);
  EXPECT_THAT(At<Port>("/app/adder/input/in3").incoming(), SizeIs(1));
  EXPECT_EQ(At<Port>("/app/counter/output/out").outgoing().back().options.queue, 4u);
  ASSERT_TRUE(history_.Redo());
  EXPECT_THAT(adder().in, SizeIs(1));
}

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

TEST_F(StaticParameterTest, ASwapGivesThePortsThatAreAskedFor) {
  EXPECT_THAT(Refusal({ReplaceModule{"/app/adder", "test/adder", {{"inputs", "1"}}}}),
              HasSubstr("has no port 'in3', which is connected"));
  Must({SetParameter{"/app/adder/inputs", "4"}, SetParameter{"/app/adder/offset", "1"},
        SetParameter{"/app/adder/inputs", "3"}});
  EXPECT_EQ(adder().offset.Get(), 1);
  Steps(1);
  EXPECT_EQ(At<Sink>("/app/sink").taken.back(), 3);
}

TEST_F(StaticParameterTest, ParametersThatFollowFromItAreSetAndKept) {
  Must({CreateModule{"/app/other", "test/adder", {{"inputs", "4"}, {"weight4", "5"}}}});
  EXPECT_EQ(At<Adder>("/app/other").weights[3].Get(), 5);
  EXPECT_THAT(Refusal({CreateModule{"/app/bad", "test/adder", {{"inputs", "4"}, {"weight5", "5"}}}}),
              HasSubstr("/app/bad: there is no parameter 'weight5'; did you mean 'weight"));
  Must({SetParameter{"/app/adder/weight3", "10"}, ReplaceModule{"/app/adder", "test/adder"}});
  EXPECT_EQ(adder().weights[2].Get(), 10);
  Must({CopyElement{"/app/adder", "copy"}});
  EXPECT_EQ(At<Adder>("/app/copy").weights[2].Get(), 10);
  ASSERT_TRUE(history_.Apply({DeleteElement{"/app/adder"}, DeleteElement{"/app/sink"}}));
  const ChangeOutcome back = history_.Undo();
  ASSERT_TRUE(back) << back.diagnostics.ToString();
  EXPECT_EQ(adder().weights[2].Get(), 10);
  ASSERT_TRUE(history_.Apply({SetParameter{"/app/adder/inputs", "1"}}));
  ASSERT_TRUE(history_.Undo());
  ASSERT_THAT(adder().weights, SizeIs(3));
  EXPECT_EQ(adder().weights[2].Get(), 10);
}

TEST_F(StaticParameterTest, WhatIsWrongLeavesAllAsItWas) {
  EXPECT_THAT(Refusal({SetParameter{"/app/adder/inputs", "9"}}), HasSubstr("9 is out of bounds"));
  EXPECT_THAT(Refusal({SetParameter{"/app/adder/inputs", "7"}}), HasSubstr("seven"));
}

TEST_F(StaticParameterTest, CannotBeSetBetweenPortsAndReadiness) {
  auto& made = runtime.Create<Adder>(runtime.root(), "by_hand");
  ASSERT_TRUE(made.inputs.Set(4));
  ASSERT_TRUE(Runtime::Construct(made));
  EXPECT_THAT(made.in, SizeIs(4));
  EXPECT_THAT(made.inputs.Set(5).error().message, HasSubstr("ports have been made by it already"));
  ASSERT_TRUE(runtime.MakeReady(made));
  EXPECT_THAT(made.in, SizeIs(4));
}

TEST_F(StaticParameterTest, OfACodeMadeModuleItStays) {
  auto& made = runtime.Create<Adder>(runtime.root(), "by_hand");
  ASSERT_TRUE(runtime.MakeReady(made));
  EXPECT_THAT(Refusal({SetParameter{"/by_hand/inputs", "5"}}), HasSubstr("was made by code"));
}

/// Told of by a change set, all together.
TEST_F(StaticParameterTest, SeveralChangesAreToldOfOnce) {
  Steps(1);
  Must({SetParameter{"/app/adder/offset", "1"}, SetParameter{"/app/adder/offset", "2"}});
  Steps(2);
  EXPECT_EQ(adder().told, 2);
}

/// By an output.
TEST_F(StaticParameterTest, AnOutputFeedsAParameter) {
  Must({ConnectPorts{"/app/counter/out", "/app/adder/offset"}});
  Steps(1);
  EXPECT_EQ(At<Sink>("/app/sink").taken.back(), 1 + 1 + 1) << "in the same cycle";
  EXPECT_EQ(adder().offset.Get(), 1);
  Must({ReplaceModule{"/app/adder", "test/adder"}});
  Steps(1);
  EXPECT_EQ(adder().offset.Get(), 2);
  ASSERT_TRUE(history_.Apply({DisconnectPorts{"/app/counter/out", "/app/adder/offset"}}));
  Steps(1);
  EXPECT_EQ(adder().offset.Get(), 2);
  ASSERT_TRUE(history_.Undo());
  Steps(1);
  EXPECT_EQ(adder().offset.Get(), 4);
  ASSERT_TRUE(history_.Apply({DeleteElement{"/app/adder"}}));
  ASSERT_TRUE(history_.Undo());
  Steps(1);
  EXPECT_EQ(adder().offset.Get(), 5);
}

}  // namespace
}  // namespace runnel::test

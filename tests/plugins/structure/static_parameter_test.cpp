#include "tests/plugins/structure/adder_fixture.h"

namespace runnel::test {
namespace {

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

#include "tests/plugins/structure/editor_fixture.h"
#include "tests/support/schedule_order.h"

namespace runnel::test {
namespace {

using ChangeSetTest = EditorTest;

TEST_F(ChangeSetTest, BuildsWhatRunsFromTheNextCycleOn) {
  Must({CreateGroup{"/app/robot"}, CreatePort{"/app/robot/number", Port::Direction::kOutput, "int32"},
        CreateModule{"/app/robot/counter", "test/counter", {{"step", "3"}, {"label", "left"}}},
        CreateModule{"/app/sink", "test/sink"}, ConnectPorts{"/app/robot/counter/out", "/app/robot/number"},
        ConnectPorts{"/app/robot/number", "/app/sink/in", {.queue = 10}}});
  Steps(3);
  EXPECT_THAT(At<Sink>("/app/sink").taken, ElementsAre(3, 6, 9));
  EXPECT_EQ(At<Counter>("/app/robot/counter").label.Get(), "left");
  EXPECT_EQ(FindModuleType(At<Counter>("/app/robot/counter")), "test/counter");
}

TEST_F(ChangeSetTest, TheNameOfTheOnlyApplicationMayBeLeftOut) {
  Must({CreateModule{"/counter", "test/counter"}, SetParameter{"counter/parameter/step", "5"}});
  EXPECT_EQ(At<Counter>("/app/counter").step.Get(), 5);
}

TEST_F(ChangeSetTest, OneMistakeAndNothingHasHappened) {
  Must({CreateModule{"/app/counter", "test/counter"}, CreateModule{"/app/sink", "test/sink"}});
  const std::string told =
      Refusal({CreateModule{"/app/more", "test/counter"}, SetParameter{"/app/counter/parameter/step", "9"},
               ConnectPorts{"/app/counter/out", "/app/sink/in"}, DeleteElement{"/app/sing"}});
  EXPECT_THAT(told, HasSubstr("no 'sing' in /app; did you mean 'sink'?"));
  EXPECT_EQ(At<Counter>("/app/counter").step.Get(), 1);
}

TEST_F(ChangeSetTest, AllMistakesAreToldAtOnce) {
  Must({CreateModule{"/app/counter", "test/counter"}});
  const std::string told =
      Refusal({CreateModule{"/app/a", "test/countr"}, CreateModule{"/app/b", "test/never_made"},
               CreateModule{"/app/c", "test/never_ready"}, CreateModule{"/app/counter", "test/counter"},
               CreateModule{"/app/d", "test/counter", {{"stap", "1"}}},
               CreateModule{"/app/e", "test/counter", {{"step", "much"}}}, CreateGroup{"/nowhere/f"},
               CreateModule{"/app/counter/g", "test/counter"}, CreateGroup{"/app/ h"},
               CreatePort{"/app/i", Port::Direction::kInput, "ints"}, SetParameter{"/app/counter/parameter/stepp", "1"},
               SetParameter{"/app/counter", "1"}, SetParameter{"/app/counter/parameter/label", "\x01"},
               ReplaceModule{"/app", "test/counter"}, AssignToThread{"/app/counter", "fest"},
               DisconnectPorts{"/app/counter/out", "/app/counter/out"}, DeleteElement{"/app/counter/output/out"},
               DeleteElement{"/"}});
  for (const char* part :
       {"did you mean 'test/counter'?", "cannot be made", "has no device", "already an element", "no parameter 'stap'",
        "much", "no 'nowhere' in /", "is not a group", "' h'", "no data type 'ints'", "did you mean 'step'?",
        "is not a parameter", "the value contains", "is not a module", "did you mean 'fast'?", "is not connected",
        "a part of a module", "the root cannot be deleted"}) {
    EXPECT_THAT(told, HasSubstr(part));
  }
}

TEST_F(ChangeSetTest, ConnectionsAreCheckedAgainstWhatWillBe) {
  Must({CreateModule{"/app/counter", "test/counter"}, CreateModule{"/app/sink", "test/sink"},
        ConnectPorts{"/app/counter/out", "/app/sink/in"}});
  EXPECT_THAT(Refusal({ConnectPorts{"/app/counter/out", "/app/sink/in"}}), HasSubstr("already"));
  EXPECT_THAT(Refusal({ConnectPorts{"/app/sink/in", "/app/counter/out"}}), HasSubstr("the other way round"));
  EXPECT_THAT(Refusal({ConnectPorts{"/app/counter/uot", "/app/sink/in"}}), HasSubstr("did you mean 'out'?"));
  EXPECT_THAT(
      Refusal({CreateModule{"/app/text", "test/text_counter"}, ConnectPorts{"/app/text/out", "/app/sink/side"}}),
      HasSubstr("carries"));
  EXPECT_THAT(Refusal({CreatePort{"/app/a", Port::Direction::kInput, "int32"},
                       CreatePort{"/app/b", Port::Direction::kInput, "int32"}, ConnectPorts{"/app/a", "/app/b"},
                       ConnectPorts{"/app/b", "/app/a"}}),
              HasSubstr("cycle"));
  EXPECT_THAT(Refusal({CreatePort{"/app/a", Port::Direction::kInput, "int32"}, ConnectPorts{"/app/a", "/app/a"}}),
              HasSubstr("itself"));
  EXPECT_THAT(Refusal({DisconnectPorts{"/app/counter/out", "/app/sink/in"},
                       DisconnectPorts{"/app/counter/out", "/app/sink/in"}}),
              HasSubstr("is not connected"));
  EXPECT_THAT(Refusal({DeleteElement{"/app/sink"}, ConnectPorts{"/app/counter/out", "/app/sink/side"}}),
              HasSubstr("no 'sink'"));
  Must({DisconnectPorts{"/app/counter/out", "/app/sink/in"},
        ConnectPorts{"/app/counter/out", "/app/sink/in", {.queue = 4}}});
  EXPECT_EQ(At<Port>("/app/counter/output/out").outgoing().front().options.queue, 4u);
}

TEST_F(ChangeSetTest, ANameThatIsLeftIsFreeForTheNext) {
  Must({CreateModule{"/app/counter", "test/counter"}, CreateModule{"/app/sink", "test/sink"},
        ConnectPorts{"/app/counter/out", "/app/sink/in"}});
  Must({DeleteElement{"/app/counter"}, CreateModule{"/app/counter", "test/other_counter"},
        ConnectPorts{"/app/counter/out", "/app/sink/in"}});
  EXPECT_EQ(FindModuleType(At<Module>("/app/counter")), "test/other_counter");
  EXPECT_THAT(At<Port>("/app/sink/input/in").incoming(), SizeIs(1));
}

TEST_F(ChangeSetTest, ADeletedGroupGoesWithAllThatIsInItAndItsConnections) {
  Must({CreateGroup{"/app/robot"}, CreateModule{"/app/robot/counter", "test/counter"},
        CreateModule{"/app/robot/sink", "test/sink"}, CreateModule{"/app/sink", "test/sink"},
        ConnectPorts{"/app/robot/counter/out", "/app/robot/sink/in"},
        ConnectPorts{"/app/robot/counter/out", "/app/sink/in", {.queue = 5}}});
  Steps(1);
  Must({DeleteElement{"/app/robot"}});
  EXPECT_FALSE(Exists("/app/robot"));
  EXPECT_THAT(At<Port>("/app/sink/input/in").incoming(), IsEmpty());
  Steps(1);
  EXPECT_THAT(At<Sink>("/app/sink").taken, ElementsAre(1));
}

TEST_F(ChangeSetTest, ModulesMoveFromThreadToThreadAndBack) {
  Must({CreateModule{"/app/counter", "test/counter"}, AssignToThread{"/app/counter", "slow"}});
  const auto& slow = At<ThreadContainer>("/threads/slow");
  EXPECT_THAT(test::OrderOf(scheduler, slow), SizeIs(1));
  Must({AssignToThread{"/app/counter", "fast"}});
  EXPECT_THAT(test::OrderOf(scheduler, slow), IsEmpty());
  Must({AssignToThread{"/app/counter", "/threads/slow"}});
  Must({AssignToThread{"/app/counter", ""}});
  EXPECT_THAT(test::OrderOf(scheduler, slow), IsEmpty()) << "unassigned: the first thread runs it";
}

TEST_F(ChangeSetTest, WhatIsRequiredAndNotConnectedIsAWarning) {
  const auto outcome = editor.Apply({CreateModule{"/app/sink", "test/sink"}});
  EXPECT_TRUE(outcome);
  EXPECT_THAT(outcome.diagnostics.ToString(), HasSubstr("/app/sink/input/side: is required"));
  const auto better =
      editor.Apply({CreateModule{"/app/other", "test/sink"}, CreateModule{"/app/counter", "test/counter"},
                    ConnectPorts{"/app/counter/out", "/app/other/side"}});
  EXPECT_THAT(better.diagnostics.warnings(), IsEmpty());
}

// The last step fails when all others have been done: others have taken the name meanwhile. Only a
// listener can come between, since the editor looks at the revision.
TEST_F(ChangeSetTest, WhatCouldNotBeForeseenIsUndone) {
  Must({CreateModule{"/app/counter", "test/counter"}, CreateModule{"/app/sink", "test/sink"},
        ConnectPorts{"/app/counter/out", "/app/sink/in", {.queue = 6}}, AssignToThread{"/app/counter", "slow"}});
  class Meddler final : public ElementListener {
   public:
    explicit Meddler(Runtime& runtime) : runtime_(runtime) {}
    void OnReady(FrameworkElement& element) override {
      if (element.name() == "first") runtime_.Create<Group>(*element.parent(), "last");
    }

   private:
    Runtime& runtime_;
  } meddler(runtime);
  runtime.AddListener(meddler);
  const auto outcome = editor.Apply(
      {SetParameter{"/app/counter/parameter/step", "4"}, AssignToThread{"/app/counter", "fast"},
       ReplaceModule{"/app/counter", "test/other_counter"}, DisconnectPorts{"/app/counter/out", "/app/sink/in"},
       ConnectPorts{"/app/counter/out", "/app/sink/side"}, DeleteElement{"/app/sink"}, CreateGroup{"/app/first"},
       CreateGroup{"/app/last"}});
  runtime.RemoveListener(meddler);
  EXPECT_FALSE(outcome);
  EXPECT_THAT(outcome.diagnostics.ToString(), HasSubstr("already an element called 'last'"));
  auto& counter = At<Counter>("/app/counter");
  EXPECT_EQ(FindModuleType(counter), "test/counter");
  EXPECT_EQ(counter.step.Get(), 1);
  EXPECT_FALSE(Exists("/app/first"));
  ASSERT_THAT(counter.out.outgoing(), SizeIs(1));
  EXPECT_EQ(counter.out.outgoing().front().options.queue, 6u);
  EXPECT_EQ(OwnThread(counter), &At<ThreadContainer>("/threads/slow"));
  Steps(1);
  EXPECT_THAT(test::OrderOf(scheduler, At<ThreadContainer>("/threads/slow")), SizeIs(1));
}

TEST_F(ChangeSetTest, IsRefusedFromWithinACycle) {
  class Meddling final : public Module {
   public:
    using Module::Module;
    StructureEditor* editor = nullptr;

   private:
    void Update() override { (void)editor->Apply({}); }
  };
  ASSERT_TRUE(modules.Add(TypeCalled<Meddling>("test/meddling")));
  Must({CreateModule{"/app/meddling", "test/meddling"}});
  At<Meddling>("/app/meddling").editor = &editor;
  Steps(1);
  const auto faults = scheduler.TakeFaults();
  ASSERT_THAT(faults, SizeIs(1));
  EXPECT_THAT(faults[0].message, HasSubstr("from within a cycle"));
}

}  // namespace
}  // namespace runnel::test

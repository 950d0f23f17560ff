// Modules and groups get another name, and others like them, while all runs on.

#include "core/element/tags.h"
#include "core/module/group_parameter.h"
#include "core/paths/late_connections.h"
#include "plugins/scheduling/thread_container.h"
#include "plugins/structure/change_history.h"
#include "plugins/structure/renamed_text.h"
#include "tests/plugins/structure/editor_fixture.h"

namespace runnel::test {
namespace {

class RenamingTest : public EditorTest {
 protected:
  RenamingTest() {
    MustDo({CreateGroup{"/app/g"}, CreateModule{"/app/g/a", "test/counter", {{"step", "2"}, {"label", "left"}}},
            CreateModule{"/app/g/inner", "test/sink"},
            CreatePort{"/app/g/out", Port::Direction::kOutput, "int32", "what it counts"},
            CreateModule{"/app/b", "test/sink"}, ConnectPorts{"/app/g/a/out", "/app/g/out"},
            ConnectPorts{"/app/g/a/out", "/app/g/inner/in", {.queue = 3}},
            ConnectPorts{"/app/g/out", "/app/b/in", {.queue = 9}}, CreateParameter{"/app/step", {"g/a/step"}, "of all"},
            AssignToThread{"/app/g", "slow"}, AssignToThread{"/app/g/a", "fast"}, AssignToThread{"/app/b", "fast"}});
  }
  void MustDo(const ChangeSet& changes) { MustBe(history.Apply(changes)); }
  static void MustBe(const ChangeOutcome& outcome) { ASSERT_TRUE(outcome) << outcome.diagnostics.ToString(); }
  int CountOf(const std::string& path) { return At<Counter>(path).count.value; }
  std::vector<std::string> NamesIn(const std::string& path) {
    std::vector<std::string> names;
    for (const FrameworkElement* each : At<FrameworkElement>(path).children()) names.push_back(each->name());
    return names;
  }

  ChangeHistory history{editor};
};

TEST_F(RenamingTest, AModuleKeepsConnectionsQueuesValuesStateThreadAndPlace) {
  Steps(3);
  EXPECT_THAT(At<Sink>("/app/b").taken, ElementsAre(2, 4, 6));
  MustDo({RenameElement{"/app/g/a", "first"}});
  EXPECT_FALSE(Exists("/app/g/a"));
  EXPECT_EQ(CountOf("/app/g/first"), 6);
  EXPECT_EQ(At<Counter>("/app/g/first").label.Get(), "left");
  EXPECT_EQ(OwnThread(At<Counter>("/app/g/first"))->name(), "fast");
  EXPECT_THAT(NamesIn("/app/g"), ElementsAre("first", "inner", "out"));
  EXPECT_EQ(NameInFile::Of(At<Counter>("/app/g/first")), "a");
  Steps(2);
  EXPECT_THAT(At<Sink>("/app/b").taken, ElementsAre(2, 4, 6, 8, 10)) << "nothing lost, nothing twice";
}

TEST_F(RenamingTest, IsUndoneAndRedone) {
  Steps(2);
  MustDo({RenameElement{"/app/g/a", "first"}});
  EXPECT_EQ(history.NextUndo(), "rename /app/g/a first");
  MustBe(history.Undo());
  EXPECT_EQ(CountOf("/app/g/a"), 4);
  EXPECT_THAT(NamesIn("/app/g"), ElementsAre("a", "inner", "out"));
  EXPECT_EQ(NameInFile::Of(At<Counter>("/app/g/a")), "a");
  MustBe(history.Redo());
  EXPECT_EQ(CountOf("/app/g/first"), 4);
}

TEST_F(RenamingTest, AGroupKeepsAllThatIsInIt) {
  Steps(3);
  MustDo({RenameElement{"/app/g", "front"}});
  EXPECT_FALSE(Exists("/app/g"));
  EXPECT_EQ(CountOf("/app/front/a"), 6);
  EXPECT_EQ(OwnThread(At<Group>("/app/front"))->name(), "slow");
  EXPECT_EQ(OwnThread(At<Counter>("/app/front/a"))->name(), "fast");
  EXPECT_EQ(At<Port>("/app/front/out").description(), "what it counts");
  EXPECT_THAT(NamesIn("/app"), ElementsAre("front", "b", "step"));
  EXPECT_THAT(NamesIn("/app/front"), ElementsAre("a", "inner", "out"));
  const auto& edges = At<Port>("/app/front/out").outgoing();
  ASSERT_THAT(edges, SizeIs(1));
  EXPECT_EQ(edges[0].options.queue, 9U);
  Steps(2);
  EXPECT_THAT(At<Sink>("/app/b").taken, ElementsAre(2, 4, 6, 8, 10));
  MustBe(history.Undo());
  EXPECT_FALSE(Exists("/app/front"));
  EXPECT_THAT(NamesIn("/app"), ElementsAre("g", "b", "step"));
  Steps(1);
  EXPECT_THAT(At<Sink>("/app/b").taken, ElementsAre(2, 4, 6, 8, 10, 12));
  EXPECT_EQ(CountOf("/app/g/a"), 12);
  MustBe(history.Redo());
  EXPECT_EQ(CountOf("/app/front/a"), 12);
}

TEST_F(RenamingTest, ParametersOfGroupsAndConnectionsThatWaitFollow) {
  MustDo({ConnectPorts{"/app/g/a/out", "/app/later/in", {.when_present = true}}});
  MustDo({RenameElement{"/app/g/a", "first"}});
  MustDo({SetParameter{"/app/step", "5"}});
  EXPECT_EQ(At<Counter>("/app/g/first").step.Get(), 5);
  EXPECT_EQ(At<GroupParameter>("/app/step").info().description, "of all");
  MustDo({RenameElement{"/app/g", "front"}});
  MustDo({SetParameter{"/app/step", "6"}});
  EXPECT_EQ(At<Counter>("/app/front/first").step.Get(), 6);
  MustDo({CreateModule{"/app/later", "test/sink"}});
  EXPECT_THAT(At<Port>("/app/later/input/in").incoming(), ElementsAre(&At<Port>("/app/front/first/output/out")));
  for (int i = 0; i < 5; ++i) MustBe(history.Undo());
  EXPECT_THAT(At<GroupParameter>("/app/step").targets(), ElementsAre("g/a/step"));
}

TEST_F(RenamingTest, AGroupTakesAlongWhatItsChangeSetHasMadeAndRenamed) {
  Steps(3);
  MustDo({CreateModule{"/app/g/more", "test/counter"}, RenameElement{"/app/g/a", "first"},
          RenameElement{"/app/g", "front"}, RenameElement{"/app/front", "last"}});
  EXPECT_THAT(NamesIn("/app"), ElementsAre("last", "b", "step"));
  EXPECT_THAT(NamesIn("/app/last"), testing::UnorderedElementsAre("first", "inner", "out", "more"));
  EXPECT_EQ(CountOf("/app/last/first"), 6);
  EXPECT_THAT(At<GroupParameter>("/app/step").targets(), ElementsAre("last/first/step"));
  Steps(2);
  EXPECT_THAT(At<Sink>("/app/b").taken, ElementsAre(2, 4, 6, 8, 10));
  MustBe(history.Undo());
  EXPECT_THAT(NamesIn("/app/g"), testing::UnorderedElementsAre("a", "inner", "out"));
  EXPECT_EQ(CountOf("/app/g/a"), 10);
  MustBe(history.Redo());
  EXPECT_EQ(CountOf("/app/last/first"), 10);
}

TEST_F(RenamingTest, AGroupHasWhatItsChangeSetSaysOfItBeforeAndAfter) {
  const auto thread_of = [&](const std::string& path) { return OwnThread(At<Group>(path))->name(); };
  MustDo({AssignToThread{"/app/g", "fast"}, TagElement{"/app/g", {"safety"}}, TagElement{"/app/g/out", {"hidden"}},
          TagElement{"/app/step", {"hidden"}}, RenameElement{"/app/g", "front"}});
  EXPECT_EQ(thread_of("/app/front"), "fast");
  EXPECT_THAT(TagsOf(At<Group>("/app/front")), ElementsAre("safety"));
  EXPECT_THAT(TagsOf(At<Port>("/app/front/out")), ElementsAre("hidden"));
  MustBe(history.Undo());
  EXPECT_EQ(thread_of("/app/g"), "slow");
  EXPECT_THAT(TagsOf(At<Group>("/app/g")), testing::IsEmpty());
  EXPECT_THAT(TagsOf(At<Port>("/app/g/out")), testing::IsEmpty());
  MustDo({RenameElement{"/app/g/a", "first"}, RenameElement{"/app/g", "front"}, AssignToThread{"/app/front", "fast"}});
  EXPECT_THAT(NamesIn("/app/front"), ElementsAre("first", "inner", "out"));
  MustBe(history.Undo());
  EXPECT_EQ(thread_of("/app/g"), "slow");
  EXPECT_THAT(NamesIn("/app/g"), ElementsAre("a", "inner", "out"));
}

TEST_F(RenamingTest, WhatIsSetAfterARenameIsTakenBackWithIt) {
  MustDo({RenameElement{"/app/b", "c"}, SetParameter{"/app/step", "7"}, RenameElement{"/app/g/a", "first"},
          SetParameter{"/app/g/first/step", "9"}});
  EXPECT_EQ(At<Counter>("/app/g/first").step.Get(), 9);
  MustBe(history.Undo());
  EXPECT_EQ(At<Counter>("/app/g/a").step.Get(), 2);
}

TEST_F(RenamingTest, SaysWhatCannotBeRenamed) {
  EXPECT_THAT(Refusal({RenameElement{"/app", "other"}}), HasSubstr("is the whole application"));
  EXPECT_THAT(Refusal({RenameElement{"/app/g/a/out", "o"}}), HasSubstr("neither a module nor a group"));
  EXPECT_THAT(Refusal({RenameElement{"/app/g/a", "inner"}}), HasSubstr("already an element called 'inner'"));
  EXPECT_THAT(Refusal({RenameElement{"/app/g/a", "x/y"}}), HasSubstr("is a path"));
  EXPECT_THAT(Refusal({RenameElement{"/app/g/a", "x y"}}), HasSubstr("x y"));
  EXPECT_THAT(Refusal({RenameElement{"/app/g/aa", "x"}}), HasSubstr("did you mean 'a'?"));
  runtime.Create<Counter>(At<FrameworkElement>("/app"), "by_code");
  MustReady();
  EXPECT_THAT(Refusal({RenameElement{"/app/by_code", "x"}}), HasSubstr("was made by code"));
}

TEST_F(RenamingTest, ACopyHasTheValuesAndNoConnections) {
  Steps(3);
  MustDo({CopyElement{"/app/g/a"}});
  const auto& copy = At<Counter>("/app/g/a_2");
  EXPECT_EQ(copy.step.Get(), 2);
  EXPECT_EQ(copy.label.Get(), "left");
  EXPECT_EQ(copy.count.value, 0);
  EXPECT_EQ(OwnThread(copy)->name(), "fast");
  EXPECT_THAT(At<Port>("/app/g/a_2/output/out").outgoing(), IsEmpty());
  MustDo({CopyElement{"/app/g/a"}});
  EXPECT_TRUE(Exists("/app/g/a_3"));
  MustBe(history.Undo());
  MustBe(history.Undo());
  EXPECT_THAT(NamesIn("/app/g"), ElementsAre("a", "inner", "out"));
}

TEST_F(RenamingTest, ACopyOfAGroupIsConnectedWithin) {
  MustDo({CopyElement{"/app/g", "second"}});
  const auto& edges = At<Port>("/app/second/a/output/out").outgoing();
  ASSERT_THAT(edges, SizeIs(2));
  EXPECT_EQ(At<Port>("/app/second/inner/input/in").incoming()[0]->path(), "/app/second/a/output/out");
  EXPECT_THAT(At<Port>("/app/second/out").outgoing(), IsEmpty());
  EXPECT_THAT(At<Port>("/app/second/out").incoming(), SizeIs(1));
  EXPECT_EQ(OwnThread(At<Group>("/app/second"))->name(), "slow");
  EXPECT_THAT(Refusal({CopyElement{"/app/g", "second"}}), HasSubstr("already an element called"));
  EXPECT_THAT(Refusal({CopyElement{"/app"}}), HasSubstr("is the whole application"));
  MustBe(history.Undo());
  EXPECT_FALSE(Exists("/app/second"));
  MustBe(history.Redo());
  EXPECT_TRUE(Exists("/app/second/inner"));
}

}  // namespace
}  // namespace runnel::test

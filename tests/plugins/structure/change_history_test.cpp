#include "plugins/structure/change_history.h"

#include "core/element/tags.h"
#include "core/log/log_level.h"
#include "core/paths/late_connections.h"
#include "tests/plugins/structure/editor_fixture.h"

namespace runnel::test {
namespace {

class ChangeHistoryTest : public EditorTest {
 protected:
  void MustDo(const ChangeSet& changes) { MustBe(history.Apply(changes)); }
  void MustBe(const ChangeOutcome& outcome) { ASSERT_TRUE(outcome) << outcome.diagnostics.ToString(); }
  std::string TextOf(const std::string& parameter) { return At<Configurable&>(parameter).ToText(); }
  template <typename E>
  std::remove_reference_t<E>& At(const std::string& path) {
    return EditorTest::At<std::remove_reference_t<E>>(path);
  }

  ChangeHistory history{editor};
};

TEST_F(ChangeHistoryTest, SaysWhatIsNextByALabel) {
  EXPECT_FALSE(history.NextUndo());
  EXPECT_FALSE(history.NextRedo());
  MustDo({CreateModule{"/app/a", "test/counter"}, CreateGroup{"/app/g"}});
  EXPECT_EQ(history.NextUndo(), "create /app/a test/counter and 1 more");
  MustBe(history.Apply({SetParameter{"/app/a/step", "3"}}, {}, "three at a time"));
  EXPECT_EQ(history.NextUndo(), "three at a time");
  MustBe(history.Undo());
  EXPECT_EQ(history.NextUndo(), "create /app/a test/counter and 1 more");
  EXPECT_EQ(history.NextRedo(), "three at a time");
  MustBe(history.Redo());
  EXPECT_EQ(TextOf("/app/a/parameter/step"), "3");
  EXPECT_EQ(history.NextUndo(), "three at a time");
  EXPECT_FALSE(history.NextRedo());
}

TEST_F(ChangeHistoryTest, ConversionsComeBackAsTheyWere) {
  MustDo({CreateModule{"/app/a", "test/text_counter"}, CreateModule{"/app/b", "test/sink"},
          ConnectPorts{"/app/a/out", "/app/b/in", {.queue = 5, .convert = "parse"}}});
  MustDo({DisconnectPorts{"/app/a/out", "/app/b/in"}});
  EXPECT_THAT(At<Port>("/app/a/output/out").outgoing(), IsEmpty());
  MustBe(history.Undo());
  const auto& edges = At<Port>("/app/a/output/out").outgoing();
  ASSERT_THAT(edges, SizeIs(1));
  EXPECT_EQ(edges[0].options.convert, "parse");
  EXPECT_TRUE(edges[0].converted);
  MustBe(history.Undo());
  MustBe(history.Redo());
}

TEST_F(ChangeHistoryTest, TagsAreSaidWhileItRunsAndComeBackWithWhatHasThem) {
  MustDo({CreateModule{"/app/a", "test/counter"}, CreateGroup{"/app/g"}});
  MustDo({TagElement{"/app/a", {"safety", "slow"}}, TagElement{"/app/g", {"hidden"}}});
  EXPECT_EQ(TagsText(At<FrameworkElement>("/app/a")), "safety slow");
  MustDo({TagElement{"/app/a", {}}});
  EXPECT_EQ(TagsText(At<FrameworkElement>("/app/a")), "");
  MustBe(history.Undo());
  MustDo({DeleteElement{"/app/a"}, DeleteElement{"/app/g"}});
  MustBe(history.Undo());
  EXPECT_EQ(TagsText(At<FrameworkElement>("/app/a")), "safety slow");
  EXPECT_EQ(TagsText(At<FrameworkElement>("/app/g")), "hidden");
  const auto wrong = history.Apply({SetParameter{"/app/a/step", "7"}, TagElement{"/app/a", {"a/b"}}});
  EXPECT_THAT(wrong.diagnostics.ToString(), HasSubstr("/app/a: 'a/b' is no tag"));
  EXPECT_NE(TextOf("/app/a/parameter/step"), "7");
}

TEST_F(ChangeHistoryTest, ConnectionsThatWaitAreUndoneAndMadeAgain) {
  MustDo({CreateModule{"/app/b", "test/sink"}});
  MustDo({ConnectPorts{"/app/a/out", "/app/b/in", {.queue = 5, .when_present = true}}});
  const auto& late = LateConnections::Of(runtime).all();
  ASSERT_THAT(late, SizeIs(1));
  EXPECT_TRUE(late[0].waits_for);
  MustBe(history.Undo());
  EXPECT_THAT(late, IsEmpty());
  MustBe(history.Redo());
  MustDo({CreateModule{"/app/a", "test/counter"}});
  ASSERT_THAT(late, SizeIs(1));
  EXPECT_FALSE(late[0].waits_for);
  ASSERT_THAT(At<Port>("/app/a/output/out").outgoing(), SizeIs(1));
  // Swapping keeps it, deleting has it wait, undoing that connects it again.
  MustDo({ReplaceModule{"/app/a", "test/other_counter"}});
  ASSERT_THAT(At<Port>("/app/a/output/out").outgoing(), SizeIs(1));
  MustDo({DeleteElement{"/app/a"}});
  ASSERT_THAT(late, SizeIs(1));
  EXPECT_TRUE(late[0].waits_for);
  MustBe(history.Undo());
  ASSERT_THAT(late, SizeIs(1));
  EXPECT_FALSE(late[0].waits_for);
  EXPECT_EQ(At<Port>("/app/a/output/out").outgoing().front().options.queue, 5U);
  // What is disconnected stays so, until that is undone.
  MustDo({DisconnectPorts{"/app/a/out", "/app/b/in"}});
  EXPECT_THAT(late, IsEmpty());
  MustBe(history.Undo());
  ASSERT_THAT(late, SizeIs(1));
  EXPECT_FALSE(late[0].waits_for);
}

TEST_F(ChangeHistoryTest, MakesWhatWasDeletedAsItWas) {
  MustDo({CreateGroup{"/app/g"}, CreateModule{"/app/g/a", "test/counter", {{"label", "left"}}},
          CreateModule{"/app/b", "test/sink"},
          CreatePort{"/app/g/out", Port::Direction::kOutput, "int32", "what it counts"},
          ConnectPorts{"/app/g/a/output/out", "/app/g/out"},
          ConnectPorts{"/app/g/out", "/app/b/input/in", {.queue = 5, .on_full = OnFull::kRefuse}},
          SetParameter{"/app/g/a/step", "4"}, AssignToThread{"/app/g", "slow"}, AssignToThread{"/app/g/a", "fast"}});
  MustDo({DeleteElement{"/app/g"}});
  EXPECT_FALSE(Exists("/app/g"));
  MustBe(history.Undo());
  EXPECT_EQ(TextOf("/app/g/a/parameter/step"), "4");
  EXPECT_EQ(TextOf("/app/g/a/parameter/label"), "left");
  EXPECT_EQ(At<Port>("/app/g/out").description(), "what it counts");
  const auto& edges = At<Port>("/app/g/out").outgoing();
  ASSERT_THAT(edges, SizeIs(1));
  EXPECT_EQ(edges[0].to->path(), "/app/b/input/in");
  EXPECT_EQ(edges[0].options.queue, 5U);
  EXPECT_EQ(edges[0].options.on_full, OnFull::kRefuse);
  EXPECT_EQ(OwnThread(At<Group>("/app/g"))->name(), "slow");
  EXPECT_EQ(OwnThread(At<Counter>("/app/g/a"))->name(), "fast");
  Steps(3);
  EXPECT_THAT(At<Sink>("/app/b").taken, ElementsAre(4, 8, 12));
}

TEST_F(ChangeHistoryTest, ThreadsComeGoAndChange) {
  MustDo({CreateModule{"/app/a", "test/counter"}});
  MustDo({AddThread{"brisk", {.period = 5ms}}, AssignToThread{"/app/a", "brisk"}});
  const auto thread = [&]() -> ThreadContainer& { return At<ThreadContainer>("/threads/brisk"); };
  EXPECT_EQ(thread().options().period, 5ms);
  EXPECT_EQ(OwnThread(At<Counter>("/app/a"))->name(), "brisk");
  MustDo({ScheduleThread{.thread = "brisk", .period = 2ms, .priority = 7}});
  EXPECT_EQ(thread().options().period, 2ms);
  EXPECT_EQ(thread().options().priority, 7);
  MustDo({DeleteElement{"/threads/brisk"}});
  EXPECT_FALSE(Exists("/threads/brisk"));
  MustBe(history.Undo());
  EXPECT_EQ(thread().options().period, 2ms);
  EXPECT_EQ(OwnThread(At<Counter>("/app/a"))->name(), "brisk") << "runs what it ran";
  MustBe(history.Undo());
  EXPECT_EQ(thread().options().period, 5ms);
  EXPECT_EQ(thread().options().priority, 0);
  MustBe(history.Undo());
  EXPECT_FALSE(Exists("/threads/brisk"));
  MustBe(history.Redo());
  MustBe(history.Redo());
  EXPECT_EQ(thread().options().priority, 7);
  EXPECT_FALSE(history.Apply({ScheduleThread{.thread = "brisk", .period = 0ms}}));
  EXPECT_FALSE(history.Apply({ScheduleThread{.thread = "brisl", .period = 1ms}}));
  EXPECT_FALSE(history.Apply({AddThread{"brisk", {}}})) << "there is one";
  EXPECT_FALSE(history.Apply({AddThread{"/app/other", {}}})) << "threads are among threads";
}

TEST_F(ChangeHistoryTest, ThreadsBeginTheirCyclesOtherwise) {
  using Activation = ThreadOptions::Activation;
  MustDo(
      {AddThread{"brisk", {.period = 5ms}}, CreateModule{"/app/a", "test/counter"}, AssignToThread{"/app/a", "brisk"}});
  const auto options = [&] { return At<ThreadContainer>("/threads/brisk").options(); };
  const auto waits = history.Apply({ScheduleThread{.thread = "brisk", .activation = Activation::kTrigger}});
  MustBe(waits);
  EXPECT_THAT(waits.diagnostics.ToString(),
              HasSubstr("/app/a: is never run: its thread /threads/brisk waits for data"));
  EXPECT_EQ(options().activation, Activation::kTrigger);
  const auto wrong = history.Apply({ScheduleThread{.thread = "brisk", .period = 1ms}});
  EXPECT_THAT(wrong.diagnostics.ToString(), HasSubstr("say activation=period, too"));
  MustDo({ScheduleThread{.thread = "brisk", .period = 1ms, .activation = Activation::kFreeRunning}});
  EXPECT_EQ(options().period, 1ms);
  MustBe(history.Undo());
  EXPECT_EQ(options().activation, Activation::kTrigger);
  MustBe(history.Undo());
  EXPECT_EQ(options().activation, Activation::kPeriod);
  MustBe(history.Redo());
  MustBe(history.Redo());
  EXPECT_EQ(options().activation, Activation::kFreeRunning);
  EXPECT_EQ(options().period, 1ms);
  MustDo({DeleteElement{"/threads/brisk"}, ScheduleThread{.thread = "fast", .activation = Activation::kTrigger}});
  const auto last = history.Apply({ScheduleThread{.thread = "slow", .activation = Activation::kTrigger}});
  EXPECT_FALSE(last);
  EXPECT_THAT(last.diagnostics.ToString(), HasSubstr("/threads/slow: no thread would be left that begins cycles"));
}

TEST_F(ChangeHistoryTest, WhatIsLoggedIsUndoneAndGoesWithItsElement) {
  using enum LogLevel;
  const auto levels = [&] { return ReadLogLevels(runtime); };
  MustDo({CreateGroup{"/app/g"}, CreateModule{"/app/g/a", "test/counter"}});
  MustDo({LogElement{"/app/g", kDebug}, LogElement{"/app/g/a", kError}, LogElement{"/", kOff}});
  EXPECT_EQ(levels(), (LogLevels{{"", kOff}, {"/app/g", kDebug}, {"/app/g/a", kError}}));
  MustDo({LogElement{"/app/g/a"}, LogElement{"/app/g", kWarning}});
  EXPECT_EQ(levels(), (LogLevels{{"", kOff}, {"/app/g", kWarning}}));
  MustBe(history.Undo());
  EXPECT_EQ(levels(), (LogLevels{{"", kOff}, {"/app/g", kDebug}, {"/app/g/a", kError}}));
  MustDo({RenameElement{"/app/g", "front"}});
  EXPECT_EQ(levels(), (LogLevels{{"", kOff}, {"/app/front", kDebug}, {"/app/front/a", kError}}));
  MustBe(history.Undo());
  EXPECT_EQ(levels(), (LogLevels{{"", kOff}, {"/app/g", kDebug}, {"/app/g/a", kError}}));
  MustDo({CopyElement{"/app/g", "other"}});
  EXPECT_EQ(levels().size(), 5U) << "a copy logs as what it was made like";
  MustBe(history.Undo());
  MustDo({DeleteElement{"/app/g"}});
  MustBe(history.Undo());
  EXPECT_EQ(levels()[2].second, kError);
  MustBe(history.Undo());
  EXPECT_THAT(history.Apply({LogElement{"/app/gg", kDebug}}).diagnostics.ToString(), HasSubstr("did you mean 'g'?"));
}

TEST_F(ChangeHistoryTest, PutsTheOldTypeBackWithItsValues) {
  MustDo({CreateModule{"/app/a", "test/other_counter", {{"own", "9"}}}, CreateModule{"/app/b", "test/sink"},
          ConnectPorts{"/app/a/out", "/app/b/in"}});
  MustDo({ReplaceModule{"/app/a", "test/counter", {{"step", "5"}, {"label", "new"}}, 0}});
  EXPECT_EQ(TextOf("/app/a/parameter/step"), "5");
  MustBe(history.Undo());
  EXPECT_EQ(TextOf("/app/a/parameter/own"), "9");
  EXPECT_EQ(TextOf("/app/a/parameter/step"), "1");  // which the other would have handed over
  EXPECT_EQ(TextOf("/app/a/parameter/label"), "none");
  EXPECT_THAT(At<Port>("/app/a/output/out").outgoing(), SizeIs(1));
  MustBe(history.Redo());
  EXPECT_FALSE(Exists("/app/a/parameter/own"));
  EXPECT_EQ(TextOf("/app/a/parameter/label"), "new");
}

TEST_F(ChangeHistoryTest, ForgetsWhatCouldBeRedoneWhenSomethingElseIsDone) {
  MustDo({CreateGroup{"/app/g"}});
  MustBe(history.Undo());
  MustDo({CreateGroup{"/app/h"}});
  EXPECT_FALSE(history.NextRedo());
  const ChangeOutcome outcome = history.Redo();
  EXPECT_TRUE(outcome.is_refused);
  EXPECT_THAT(outcome.diagnostics.ToString(), HasSubstr("there is nothing to be redone"));
}

TEST_F(ChangeHistoryTest, DoesNotRememberWhatWasRefused) {
  EXPECT_FALSE(history.Apply({DeleteElement{"/app/none"}}));
  EXPECT_FALSE(history.NextUndo());
}

TEST_F(ChangeHistoryTest, ForgetsTheOldest) {
  ChangeHistory small(editor, 2);
  for (const char* name : {"/app/a", "/app/b", "/app/c"}) {
    MustBe(small.Apply({CreateGroup{name}}));
  }
  MustBe(small.Undo());
  MustBe(small.Undo());
  EXPECT_FALSE(small.Undo());
  EXPECT_TRUE(Exists("/app/a"));
  EXPECT_FALSE(Exists("/app/b"));
}

TEST_F(ChangeHistoryTest, RefusesWhatOthersHaveMadeImpossibleAndForgetsOnlyThat) {
  MustDo({CreateModule{"/app/a", "test/counter"}});
  MustDo({SetParameter{"/app/a/step", "3"}});
  MustDo({CreateModule{"/app/b", "test/counter"}});
  Must({DeleteElement{"/app/b"}});
  const std::string before = Structure();
  const ChangeOutcome outcome = history.Undo();
  EXPECT_TRUE(outcome.is_refused);
  EXPECT_EQ(Structure(), before);
  EXPECT_THAT(outcome.diagnostics.ToString(), HasSubstr("no 'b' in /app"));
  EXPECT_THAT(outcome.diagnostics.ToString(),
              HasSubstr("'create /app/b test/counter' can no longer be undone, and is forgotten"));
  MustBe(history.Undo());
  EXPECT_EQ(TextOf("/app/a/parameter/step"), "1");
}

TEST_F(ChangeHistoryTest, DeletesNothingThatOthersHavePutIn) {
  MustDo({CreateGroup{"/app/g"}});
  Must({CreateModule{"/app/g/theirs", "test/counter"}});
  EXPECT_THAT(history.Undo().diagnostics.ToString(), HasSubstr("has got 'theirs' meanwhile"));
  EXPECT_TRUE(Exists("/app/g/theirs"));
}

TEST_F(ChangeHistoryTest, LeavesAloneWhatOthersHaveReplaced) {
  MustDo({CreateModule{"/app/a", "test/counter"}});
  Must({ReplaceModule{"/app/a", "test/other_counter"}});
  EXPECT_THAT(history.Undo().diagnostics.ToString(),
              HasSubstr("is not what it was any more: test/other_counter instead of test/counter"));
  EXPECT_TRUE(Exists("/app/a"));
}

TEST_F(ChangeHistoryTest, LeavesAloneWhatHasComeBackByItself) {
  MustDo({CreateModule{"/app/a", "test/counter", {{"step", "3"}}}});
  MustDo({ReplaceModule{"/app/a", "test/faulty"}});
  Steps(3);  // its probation ends with the old one back
  ASSERT_EQ(TextOf("/app/a/parameter/step"), "3");
  EXPECT_THAT(history.Undo().diagnostics.ToString(),
              HasSubstr("is not what it was any more: test/counter instead of test/faulty"));
  MustBe(history.Undo());
  EXPECT_FALSE(Exists("/app/a"));
}

TEST_F(ChangeHistoryTest, SaysWhatNoChangeCanMakeAgain) {
  runtime.Create<Counter>(At<Group>("/app"), "code");
  MustReady();
  MustDo({DeleteElement{"/app/code"}});
  EXPECT_TRUE(history.NextUndo());
  const std::string text = history.Undo().diagnostics.ToString();
  EXPECT_THAT(text, HasSubstr("/app/code: could not be made again"));
  EXPECT_FALSE(history.NextUndo());
}

TEST_F(ChangeHistoryTest, KeepsWhatCouldNotBeUndoneJustNow) {
  EditorOptions hasty{.timeout = 1ms};
  StructureEditor impatient(runtime, modules, &scheduler, hasty);
  ChangeHistory kept(impatient);
  MustBe(kept.Apply({CreateModule{"/app/a", "test/counter"}}));
  // Somebody is in a cycle that does not come to an end.
  std::atomic<bool> is_in{false};
  std::atomic<bool> may_end{false};
  class Slow final : public Module {
   public:
    Slow(const Placement& placement, std::atomic<bool>& in, std::atomic<bool>& end)
        : Module(placement), in_(in), end_(end) {}

   private:
    void Update() override {
      in_ = true;
      WaitUntil("the cycle may end", [this] { return end_.load(); });
    }
    std::atomic<bool>& in_;
    std::atomic<bool>& end_;
  };
  runtime.Create<Slow>(At<Group>("/app"), "slow", is_in, may_end);
  MustReady();
  std::thread running([this] { (void)scheduler.Step(); });
  WaitUntil("somebody is in a cycle", [&] { return is_in.load(); });
  const ChangeOutcome outcome = kept.Undo();
  EXPECT_FALSE(outcome);
  EXPECT_FALSE(outcome.is_refused);
  EXPECT_TRUE(kept.NextUndo());
  may_end = true;
  running.join();
  MustBe(kept.Undo());
}

}  // namespace
}  // namespace runnel::test

// Modules that are paused stay so, whatever becomes of the structure around them.

#include "plugins/structure/change_history.h"
#include "tests/plugins/structure/editor_fixture.h"

namespace runnel::test {

namespace {

class PausingTest : public EditorTest {
 protected:
  PausingTest() {
    MustDo({CreateGroup{"/app/robot"}, CreateModule{"/app/robot/source", "test/counter"},
            CreateModule{"/app/robot/sink", "test/sink"}, ConnectPorts{"/app/robot/source/out", "/app/robot/sink/in"}});
  }
  void MustDo(const ChangeSet& changes) { MustBe(history.Apply(changes)); }
  static void MustBe(const ChangeOutcome& outcome) { ASSERT_TRUE(outcome) << outcome.diagnostics.ToString(); }
  void Pause(const std::string& path) { ASSERT_TRUE(scheduler.SetPaused(path, true)); }
  // Whether it is, and is known to be.
  testing::AssertionResult IsPaused(const std::string& path) {
    auto& element = At<FrameworkElement>(path);
    const std::uint64_t before = At<Port>(path + "/output/out").publications();
    Steps(3);
    const bool ran = At<Port>(path + "/output/out").publications() != before;
    if (ran == scheduler.IsPaused(element)) {
      return testing::AssertionFailure() << "it runs: " << ran << ", and is said to be paused: " << !ran;
    }
    return ran ? testing::AssertionFailure() << "it runs" : testing::AssertionSuccess();
  }

  ChangeHistory history{editor};
};

TEST_F(PausingTest, AModuleStaysPausedUnderAnotherName) {
  Pause("/app/robot/source");
  MustDo({RenameElement{"/app/robot/source", "clock"}});
  EXPECT_TRUE(IsPaused("/app/robot/clock"));
  EXPECT_THAT(scheduler.PausedPaths(), ElementsAre("/app/robot/clock"));
  MustBe(history.Undo());
  EXPECT_TRUE(IsPaused("/app/robot/source"));
  ASSERT_TRUE(scheduler.SetPaused("/app/robot/source", false));
  EXPECT_FALSE(IsPaused("/app/robot/source"));
  EXPECT_THAT(scheduler.PausedPaths(), IsEmpty());
}

TEST_F(PausingTest, AGroupStaysPausedUnderAnotherName) {
  Pause("/app/robot");
  MustDo({RenameElement{"/app/robot", "rover"}});
  EXPECT_TRUE(IsPaused("/app/rover/source"));
  EXPECT_THAT(scheduler.PausedPaths(), ElementsAre("/app/rover"));
  MustDo({CreateModule{"/app/rover/later", "test/counter"}});
  EXPECT_TRUE(IsPaused("/app/rover/later"));
  ASSERT_TRUE(scheduler.SetPaused("/app/rover", false));
  EXPECT_FALSE(IsPaused("/app/rover/source"));
}

TEST_F(PausingTest, WhatIsInAGroupOfAnotherNameStaysPaused) {
  Pause("/app/robot/source");
  MustDo({RenameElement{"/app/robot", "rover"}});
  EXPECT_TRUE(IsPaused("/app/rover/source"));
}

TEST_F(PausingTest, WhatTakesItsPlaceIsPaused) {
  Pause("/app/robot/source");
  MustDo({ReplaceModule{"/app/robot/source", "test/other_counter"}});
  EXPECT_TRUE(IsPaused("/app/robot/source"));
  ASSERT_TRUE(scheduler.SetPaused("/app/robot/source", false));
  MustBe(history.Undo());
  EXPECT_FALSE(IsPaused("/app/robot/source")) << "somebody has let it go on meanwhile";
}

TEST_F(PausingTest, WhatIsMadeAgainOrLikeItIsPaused) {
  Pause("/app/robot/source");
  MustDo({DeleteElement{"/app/robot/source"}});
  EXPECT_THAT(scheduler.PausedPaths(), IsEmpty());
  MustBe(history.Undo());
  EXPECT_TRUE(IsPaused("/app/robot/source"));
  MustDo({CopyElement{"/app/robot/source", "second"}});
  EXPECT_TRUE(IsPaused("/app/robot/second"));
}

// Another module of the same name is another module.
TEST_F(PausingTest, WhatIsMadeLaterAtItsPathRuns) {
  Pause("/app/robot/source");
  MustDo({DeleteElement{"/app/robot/source"}});
  MustDo({CreateModule{"/app/robot/source", "test/counter"}});
  EXPECT_FALSE(IsPaused("/app/robot/source"));
}

}  // namespace

}  // namespace runnel::test

// Modules that take long to be made keep nobody from the structure lock.

#include <atomic>
#include <future>

#include <gtest/gtest.h>

#include "plugins/structure/change_history.h"
#include "plugins/structure/value_by_hand.h"
#include "tests/plugins/structure/editor_fixture.h"

namespace runnel::test {

namespace {

/// Its constructor, or Prepare(), waits until the test lets it go on.
class Slow : public Module {
 public:
  enum class At { kNowhere, kConstructor, kPrepare };
  static inline std::atomic<At> waits_at{At::kNowhere};
  static inline std::atomic<int> waiting{0};
  static inline std::atomic<int> made{0};

  explicit Slow(const Placement& placement) : Module(placement) {
    ++made;
    WaitAt(At::kConstructor);
  }
  Input<int> in{this, "in"};
  Output<int> out{this, "out"};

 private:
  static void WaitAt(At place) {
    if (waits_at != place) return;
    ++waiting;
    WaitUntil("the test lets the module go on", [place] { return waits_at != place; });
    --waiting;
  }
  Result<void> Prepare() override {
    WaitAt(At::kPrepare);
    return {};
  }
  void Update() override {}
};

class SlowComposite final : public Group {
 public:
  explicit SlowComposite(const Placement& placement) : Group(placement) { runtime().Create<Slow>(*this, "inner"); }
};

class SlowModuleTest : public EditorTest, public ::testing::WithParamInterface<Slow::At> {
 protected:
  SlowModuleTest() {
    Register<Slow>("test/slow");
    Register<SlowComposite>("test/slow_composite");
    Slow::waits_at = Slow::At::kNowhere;
    Slow::made = 0;
    Must({CreateModule{"/app/one", "test/slow"}, CreateModule{"/app/sink", "test/sink"}, CreateGroup{"/app/g"},
          CreateModule{"/app/g/two", "test/slow"}});
    Slow::made = 0;
  }

  // While modules of `changes` wait, others can change the structure; each module is made once.
  void NobodyIsKeptWaitingBy(const ChangeSet& changes, int modules = 1) {
    Slow::waits_at = GetParam();
    auto applied = std::async(std::launch::async, [&] { return editor.Apply(changes); });
    WaitUntil("the module is being made", [] { return Slow::waiting > 0; });
    const int five = 5;
    EXPECT_TRUE(PublishByHand(At<Port>("/app/sink/input/side"), &five));
    EXPECT_TRUE(At<Port>("/app/sink/input/side").Release());
    EXPECT_TRUE(runtime.MakeReady(runtime.Create<Group>(At<FrameworkElement>("/app"), "other")));
    EXPECT_EQ(Slow::waiting, 1) << "still being made";
    Slow::waits_at = Slow::At::kNowhere;
    const ChangeOutcome outcome = applied.get();
    EXPECT_TRUE(outcome) << outcome.diagnostics.ToString();
    EXPECT_EQ(Slow::made, modules);
  }
};

}  // namespace

INSTANTIATE_TEST_SUITE_P(, SlowModuleTest, ::testing::Values(Slow::At::kConstructor, Slow::At::kPrepare),
                         [](const auto& at) { return at.param == Slow::At::kPrepare ? "Prepare" : "Constructor"; });

TEST_P(SlowModuleTest, ThatIsCreated) { NobodyIsKeptWaitingBy({CreateModule{"/app/new", "test/slow"}}); }

TEST_P(SlowModuleTest, ThatIsCreatedTwiceInTheSamePlace) {
  NobodyIsKeptWaitingBy({CreateGroup{"/app/h"}, CreateModule{"/app/h/new", "test/slow"}, DeleteElement{"/app/h"},
                         CreateGroup{"/app/h"}, CreateModule{"/app/h/new", "test/slow"}},
                        2);
}

TEST_P(SlowModuleTest, ThatTakesThePlaceOfAnother) { NobodyIsKeptWaitingBy({ReplaceModule{"/app/one", "test/slow"}}); }

TEST_P(SlowModuleTest, ThatIsCopied) { NobodyIsKeptWaitingBy({CopyElement{"/app/one"}}); }

TEST_P(SlowModuleTest, ThatGetsAnotherNameWithItsGroup) {
  NobodyIsKeptWaitingBy({RenameElement{"/app/g", "h"}});
  EXPECT_TRUE(Exists("/app/h/two"));
}

TEST_P(SlowModuleTest, ThatIsPartOfAComposite) {
  NobodyIsKeptWaitingBy({CreateModule{"/app/new", "test/slow_composite"}});
  EXPECT_TRUE(Exists("/app/new/inner"));
}

TEST_P(SlowModuleTest, IsThrownAwayWhereItsPlaceIsTakenMeanwhile) {
  Slow::waits_at = GetParam();
  auto applied = std::async(std::launch::async, [&] { return editor.Apply({CreateModule{"/app/new", "test/slow"}}); });
  WaitUntil("the module is being made", [] { return Slow::waiting > 0; });
  EXPECT_TRUE(runtime.MakeReady(runtime.Create<Group>(At<FrameworkElement>("/app"), "new")));
  Slow::waits_at = Slow::At::kNowhere;
  const ChangeOutcome outcome = applied.get();
  EXPECT_THAT(outcome.diagnostics.ToString(), HasSubstr("there is already an element called 'new'"));
}

TEST_P(SlowModuleTest, IsGivenWhatHasBeenSetMeanwhile) {
  Slow::waits_at = GetParam();
  auto applied = std::async(std::launch::async, [&] { return editor.Apply({ReplaceModule{"/app/one", "test/slow"}}); });
  WaitUntil("the module is being made", [] { return Slow::waiting > 0; });
  const int five = 5;
  EXPECT_TRUE(PublishByHand(At<Port>("/app/one/input/in"), &five));
  EXPECT_TRUE(At<Port>("/app/one/input/in").SetDriving(true, AnyValue(0), {}, DrivingKind::kEffort));
  EXPECT_TRUE(At<Port>("/app/one/input/in").Block());
  Slow::waits_at = Slow::At::kNowhere;
  EXPECT_TRUE(applied.get());
  EXPECT_TRUE(At<Port>("/app/one/input/in").is_set_by_hand());
  EXPECT_TRUE(At<Port>("/app/one/input/in").is_blocked());
}

}  // namespace runnel::test

// What has been set at elements while the application runs, and what becomes of it when they are made again.

#include <gtest/gtest.h>

#include "core/element/tags.h"
#include "core/log/log_level.h"
#include "core/port/hand_slot.h"
#include "core/port/port_options.h"
#include "core/port/port_stop.h"
#include "plugins/structure/change_history.h"
#include "plugins/structure/value_by_hand.h"
#include "tests/plugins/structure/editor_fixture.h"

namespace runnel::test {

namespace {

class KeptStateTest : public EditorTest {
 protected:
  KeptStateTest() {
    MustDo({CreateModule{"/app/sink", "test/sink"}, CreateModule{"/app/source", "test/other_counter"}});
    const InputLimits limits{.minimum = 0, .maximum = 1};
    Port& side = At<Port>("/app/sink/input/side");
    EXPECT_TRUE(side.SetLimits(limits));
    side.Annotate(std::make_unique<GivenLimits>(limits));
    const int five = 5;
    EXPECT_TRUE(PublishByHand(At<Port>("/app/source/input/extra"), &five));
    EXPECT_TRUE(SetTags(At<FrameworkElement>("/app/source"), {"safety"}));
    SetLogLevel(runtime, "/app/source", LogLevel::kDebug);
  }

  void MustDo(const ChangeSet& changes) { MustBe(history.Apply(changes)); }
  static void MustBe(const ChangeOutcome& outcome) { ASSERT_TRUE(outcome) << outcome.diagnostics.ToString(); }

  // What has been set, of a sink and of a source.
  std::string SetAtSink(const std::string& path) {
    const Port& side = At<Port>(path + "/input/side");
    return BoundsText(side.limits()) + (side.FindAnnotation<GivenLimits>() != nullptr ? " given" : "");
  }
  std::string SetAtSource(const std::string& path) {
    std::string text = TagsText(At<FrameworkElement>(path));
    At<Port>(path + "/input/extra").VisitLatest([&](const void* value, ValueTimes) {
      text += " " + std::to_string(*static_cast<const int*>(value));
    });
    for (const auto& [whose, level] : ReadLogLevels(runtime)) {
      if (whose == path) text += " " + LogLevelName(level);
    }
    return text;
  }
  static constexpr const char* kAtSink = "0 .. 1 given";
  static constexpr const char* kAtSource = "safety 5 debug";

  ChangeHistory history{editor};
};

}  // namespace

TEST_F(KeptStateTest, IsBackWhenADeletionIsUndone) {
  MustDo({DeleteElement{"/app/sink"}, DeleteElement{"/app/source"}});
  EXPECT_TRUE(ReadLogLevels(runtime).empty());
  MustBe(history.Undo());
  EXPECT_EQ(SetAtSink("/app/sink"), kAtSink);
  EXPECT_EQ(SetAtSource("/app/source"), kAtSource);
}

TEST_F(KeptStateTest, IsBackWhenTheDeletionOfAGroupIsUndone) {
  MustDo({CreateGroup{"/app/g"}, CreateModule{"/app/g/source", "test/other_counter"},
          CreatePort{"/app/g/in", Port::Direction::kInput, TypeOf<int>().name()},
          ConnectPorts{"/app/g/in", "/app/g/source/extra"}});
  const int seven = 7;
  ASSERT_TRUE(PublishByHand(At<Port>("/app/g/in"), &seven));
  ASSERT_TRUE(SetTags(At<FrameworkElement>("/app/g/in"), {"hidden"}));
  MustDo({DeleteElement{"/app/g"}});
  MustBe(history.Undo());
  EXPECT_EQ(TagsText(At<FrameworkElement>("/app/g/in")), "hidden");
  int seen = 0;
  At<Port>("/app/g/source/input/extra").VisitLatest([&](const void* value, ValueTimes) {
    seen = *static_cast<const int*>(value);
  });
  EXPECT_EQ(seen, 7);
}

TEST_F(KeptStateTest, IsThatOfACopyToo) {
  MustDo({CopyElement{"/app/sink", "sink2"}, CopyElement{"/app/source", "source2"}});
  EXPECT_EQ(SetAtSink("/app/sink2"), kAtSink);
  EXPECT_EQ(SetAtSource("/app/source2"), kAtSource);
}

TEST_F(KeptStateTest, IsAStopThatIsBackWhenADeletionIsUndone) {
  Port& side = At<Port>("/app/sink/input/side");
  ASSERT_TRUE(side.SetDriving(true, AnyValue(1), std::chrono::milliseconds(300), DrivingKind::kEffort));
  ASSERT_TRUE(side.Block());
  MustDo({DeleteElement{"/app/sink"}});
  MustBe(history.Undo());
  MustDo({CopyElement{"/app/sink", "sink2"}});
  for (const char* path : {"/app/sink/input/side", "/app/sink2/input/side"}) {
    const Port& again = At<Port>(path);
    EXPECT_TRUE(again.is_blocked()) << path;
    EXPECT_TRUE(again.is_driving()) << path;
    EXPECT_EQ(*static_cast<const int*>(again.stop()->safe_value().get()), 1);
    EXPECT_EQ(again.stop()->brake(), std::chrono::milliseconds(300));
  }
  MustDo({RenameElement{"/app/sink", "drain"}});
  EXPECT_TRUE(At<Port>("/app/drain/input/side").is_blocked());
}

TEST_F(KeptStateTest, LeavesNothingToWhoWatchesADeadlineWhenItsPortIsGone) {
  const auto slot = HandSlot::Find(At<Port>("/app/source/input/extra"));
  ASSERT_NE(slot, nullptr);
  ASSERT_NE(slot->stand_in, nullptr);
  MustDo({DeleteElement{"/app/source"}});
  EXPECT_EQ(slot->stand_in, nullptr);
  MustBe(history.Undo());
  EXPECT_EQ(slot->stand_in, nullptr) << "who drove the port before drives it no more";
  EXPECT_NE(HandSlot::Find(At<Port>("/app/source/input/extra"))->stand_in, nullptr);
  MustDo({RenameElement{"/app/source", "well"}});
  EXPECT_NE(HandSlot::Find(At<Port>("/app/well/input/extra"))->stand_in, nullptr) << "another name has no part in it";
}

TEST_F(KeptStateTest, IsNoCommandFromAfterAReleaseThatItCameBefore) {
  ASSERT_TRUE(history.Apply({CreateModule{"/app/driven", "test/other_counter"}}));
  constexpr const char* kExtra = "/app/driven/input/extra";
  const auto seen = [&] {
    int newest = -1;
    At<Port>(kExtra).VisitLatest([&](const void* value, ValueTimes) { newest = *static_cast<const int*>(value); });
    return newest;
  };
  for (const bool is_deleted_in_between : {true, false}) {
    const int five = 5;
    ASSERT_TRUE(At<Port>(kExtra).SetDriving(true, 0, {}, DrivingKind::kEffort));
    ASSERT_TRUE(PublishByHand(At<Port>(kExtra), &five));
    EXPECT_EQ(seen(), 5);
    ASSERT_TRUE(runtime.robot_stop().Press("a test"));
    if (is_deleted_in_between) {
      ASSERT_TRUE(history.Apply({DeleteElement{"/app/driven"}}));
    }
    ASSERT_TRUE(runtime.robot_stop().Release("a test"));
    Steps(1);
    if (!is_deleted_in_between) {
      ASSERT_TRUE(history.Apply({DeleteElement{"/app/driven"}}));
    }
    ASSERT_TRUE(history.Undo());
    EXPECT_EQ(seen(), 0);
    EXPECT_TRUE(At<Port>(kExtra).is_set_by_hand());
  }
}

TEST_F(KeptStateTest, GoesWithAnotherName) {
  MustDo({RenameElement{"/app/sink", "drain"}, RenameElement{"/app/source", "well"}});
  EXPECT_EQ(SetAtSink("/app/drain"), kAtSink);
  EXPECT_EQ(SetAtSource("/app/well"), kAtSource);
  MustBe(history.Undo());
  EXPECT_EQ(SetAtSource("/app/source"), kAtSource);
  EXPECT_EQ(ReadLogLevels(runtime).size(), 1U);
}

TEST_F(KeptStateTest, IsToldToGoWithAPortThatASwappedInModuleHasNot) {
  const auto swapped = history.Apply({ReplaceModule{"/app/source", "test/counter", {}, 0}});
  MustBe(swapped);
  EXPECT_THAT(
      swapped.diagnostics.ToString(),
      HasSubstr(
          "/app/source/input/extra: its value by hand went with it: the new module has no port that takes it over"));
  MustBe(history.Undo());
  EXPECT_EQ(SetAtSource("/app/source"), kAtSource);
}

TEST_F(KeptStateTest, OfAModuleThatFailedIsThatOfTheOneWhichIsBack) {
  MustDo({ReplaceModule{"/app/source", "test/faulty"}});
  ASSERT_TRUE(SetTags(At<FrameworkElement>("/app/source"), {"later"}));
  Steps(1);
  EXPECT_EQ(FindModuleType(At<FrameworkElement>("/app/source")), "test/other_counter");
  EXPECT_EQ(SetAtSource("/app/source"), "later 5 debug");
}

}  // namespace runnel::test

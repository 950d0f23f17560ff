// What has been set of the parameters of modules of different kinds, where one takes the place of another and goes again.

#include <stdexcept>
#include <string>

#include <gmock/gmock.h>

#include "tests/plugins/application_tags/made_again_fixture.h"

namespace runnel::testing {
namespace {

using ::testing::HasSubstr;

struct Narrow final : Module {
  using Module::Module;
  Parameter<double> gain{this, "gain", {.default_value = 1.0, .bounds = {0.0, 3.0}, .unit = "m"}};
  Parameter<double> speed{this, "speed", {.default_value = 1.0}};
  void Update() override {}
};
template <typename Own>
struct Throwing : Module {
  using Module::Module;
  static inline bool throws = false;
  void Update() override {
    if (throws) throw std::runtime_error("no");
  }
};
struct Wide final : Throwing<Wide> {
  using Throwing::Throwing;
  Parameter<double> gain{this, "gain", {.default_value = 1.0, .bounds = {0.0, 10.0}, .unit = "m"}};
  Parameter<double> speed{this, "speed", {.default_value = 1.0}};
};
struct Centimetres final : Throwing<Centimetres> {
  using Throwing::Throwing;
  Parameter<double> gain{this, "gain", {.default_value = 1.0, .bounds = {0.0, 1000.0}, .unit = "cm"}};
};

class ValuesPutBack : public MadeAgain {
 protected:
  ValuesPutBack() {
    workshop_.Add<Narrow>("test/narrow");
    workshop_.Add<Wide>("test/wide");
    workshop_.Add<Centimetres>("test/centimetres");
    Wide::throws = Centimetres::throws = false;
  }
  // What is said of it.
  std::string LetFail(bool& throws, const std::string& path = "/demo/other") {
    throws = true;
    Run();
    const auto faults = scheduler_->TakeFaults();
    EXPECT_EQ(dynamic_cast<Wide*>(*workshop_.runtime.root().Find(path)), nullptr);
    return faults.empty() ? "" : faults.front().message;
  }
};

inline constexpr const char* kNarrow = R"(<module name="other" type="test/narrow" thread="control"/>)";
inline constexpr const char* kNarrowConnected = R"(<module name="other" type="test/narrow" thread="control"/>
  <connect from="source/value" to="other/gain"/>)";

TEST_F(ValuesPutBack, AreAllTakenOverButTheRefusedOneWhichIsTold) {
  Start(kNarrow);
  Do({SetParameter{"/demo/other/speed", "4"}});
  Do({ReplaceModule{"/demo/other", "test/wide", {}, 1000}});
  Do({SetParameter{"/demo/other/gain", "8"}});
  Do({SetParameter{"/demo/other/speed", "0"}});
  EXPECT_THAT(LetFail(Wide::throws), HasSubstr("8 m is out of bounds"));
  EXPECT_EQ(Run("/demo/other/parameter/speed"), 0);
  EXPECT_EQ(Run(), 1);
}

TEST_F(ValuesPutBack, AreThereThoughThatOfAnOutputIsRefused) {
  Start(kNarrowConnected);
  Do({ReplaceModule{"/demo/other", "test/wide", {}, 1000}});
  Say(8);
  EXPECT_EQ(Run(), 8);
  Do({SetParameter{"/demo/other/speed", "0"}});
  LetFail(Wide::throws);
  EXPECT_EQ(Run("/demo/other/parameter/speed"), 0);
  EXPECT_EQ(Run(), 1);
}

TEST_F(ValuesPutBack, OfAnOutputDoNotKeepAChangeFromBeingTakenBack) {
  Start(kNarrowConnected);
  Say(2);
  Run();
  ASSERT_TRUE(history_->Apply({ReplaceModule{"/demo/other", "test/wide"}}));
  Say(8);
  EXPECT_EQ(Run(), 8);
  const ChangeOutcome undone = history_->Undo();
  EXPECT_TRUE(undone) << undone.diagnostics.ToString();
}

TEST_F(ValuesPutBack, AreConvertedWhereTheUnitIsAnother) {
  Start(kNarrowConnected);
  Do({SetParameter{"/demo/other/gain", "3"}});
  for (const bool is_fed : {false, true}) {
    if (is_fed) Say(2);
    Run();
    Centimetres::throws = false;
    Do({ReplaceModule{"/demo/other", "test/centimetres", {}, 1000}});
    EXPECT_EQ(Run(), is_fed ? 200 : 300);
    Do({SetParameter{"/demo/other/gain", "90"}});
    LetFail(Centimetres::throws);
    EXPECT_EQ(Run(), 0.9);
  }
}

TEST_F(ValuesPutBack, AreNotThoseOfTheChangeThatHasFailed) {
  Start(kOther);
  Do({SetParameter{"/demo/other/gain", "5"}});
  Do({ReplaceModule{"/demo/other", "test/fragile", {}, 1000}, SetParameter{"/demo/other/gain", "9"}});
  EXPECT_EQ(Run(), 9);
  LetFail(Fragile::throws);
  EXPECT_EQ(Run(), 5);
}

TEST_F(ValuesPutBack, AreNotWhatHasBeenTakenBackDuringTheTrial) {
  Start(std::string(kOther) + R"(<module name="stubborn" type="test/stubborn" thread="control"/>)");
  Do({SetParameter{"/demo/other/gain", "0"}});
  Do({ReplaceModule{"/demo/other", "test/fragile", {{"gain", "9"}}, 1000}});
  const SetParameter set{"/demo/other/gain", "7"};
  EXPECT_FALSE(changes_->Apply({set, ReplaceModule{"/demo/stubborn", "test/stubborn"}}));
  ASSERT_TRUE(history_->Apply({set}));
  ASSERT_TRUE(history_->Undo());
  EXPECT_EQ(Run(), 9);
  LetFail(Fragile::throws);
  EXPECT_EQ(Run(), 0);
}

TEST_F(ValuesPutBack, AreThoseOfAPersonWhoHasSetThemLast) {
  Start(std::string(kConnected) + R"(<module name="stubborn" type="test/stubborn" thread="control"/>)");
  Say(2);
  EXPECT_EQ(Run(), 2);
  ASSERT_TRUE(history_->Apply({SetParameter{"/demo/other/gain", "5"}}));
  ASSERT_TRUE(history_->Undo());
  Do({SetParameter{"/demo/other/gain", "0"}});
  EXPECT_EQ(Run(), 0);
  ASSERT_TRUE(history_->Apply({SetParameter{"/demo/other/gain", "0"}, SetParameter{"/demo/other/text", "x"}}));
  Do({ReplaceModule{"/demo/other", "test/source"}});
  EXPECT_EQ(Run(), 0);
  EXPECT_FALSE(
      changes_->Apply({SetParameter{"/demo/other/gain", "7"}, ReplaceModule{"/demo/stubborn", "test/stubborn"}}));
  EXPECT_EQ(Run(), 0);
}

TEST_F(ValuesPutBack, AreThoseThatAnotherHasSetSinceThatChange) {
  Start(kConnected);
  Do({SetParameter{"/demo/other/gain", "5"}});
  Say(2);
  EXPECT_EQ(Run(), 2);
  ASSERT_TRUE(history_->Apply({ReplaceModule{"/demo/other", "test/source"}}));
  Do({SetParameter{"/demo/other/gain", "0"}});
  ASSERT_TRUE(history_->Undo());
  EXPECT_EQ(Run(), 0);
}

// What the one that comes back refuses is newer than what it had of the output, and stands for nothing itself.
TEST_F(ValuesPutBack, AreAPersonsWhereThatOfTheOutputIsRefused) {
  Start(kNarrowConnected);
  Say(2);
  EXPECT_EQ(Run(), 2);
  for (const char* const value : {"0.5", "3"}) ASSERT_TRUE(history_->Apply({SetParameter{"/demo/other/gain", value}}));
  Do({ReplaceModule{"/demo/other", "test/wide", {}, 1000}});
  Say(8);
  EXPECT_EQ(Run(), 8);
  LetFail(Wide::throws);
  EXPECT_EQ(Run(), 3);
  ASSERT_TRUE(history_->Undo());
  EXPECT_EQ(Run(), 0.5);
  Wide::throws = false;
  Do({ReplaceModule{"/demo/other", "test/wide", {}, 1000}});
  Say(9);
  EXPECT_EQ(Run(), 9);
  Do({SetParameter{"/demo/other/gain", "0"}});
  LetFail(Wide::throws);
  EXPECT_EQ(Run(), 0);
}

TEST_F(ValuesPutBack, AreThoseSetSinceInWhateverUnit) {
  Start(kNarrow);
  Do({SetParameter{"/demo/other/gain", "3"}});
  ASSERT_TRUE(history_->Apply({ReplaceModule{"/demo/other", "test/centimetres"}}));
  EXPECT_EQ(Run(), 300);
  Do({SetParameter{"/demo/other/gain", "50"}});
  ASSERT_TRUE(history_->Undo());
  EXPECT_EQ(Run(), 0.5);
}

TEST_F(ValuesPutBack, AreNotRefusedForThoseInTheirPlace) {
  Start(kNarrow);
  Do({SetParameter{"/demo/other/gain", "2"}});
  ASSERT_TRUE(history_->Apply({ReplaceModule{"/demo/other", "test/wide", {{"gain", "9"}}}}));
  const ChangeOutcome undone = history_->Undo();
  EXPECT_TRUE(undone) << undone.diagnostics.ToString();
  EXPECT_EQ(Run(), 2);
}

TEST_F(ValuesPutBack, OfAnOutputThatTheNewOneCannotHaveKeepItOut) {
  Start(R"(<module name="other" type="test/wide" thread="control"/><connect from="source/value" to="other/gain"/>)");
  Say(8);
  EXPECT_EQ(Run(), 8);
  const ChangeOutcome swapped = changes_->Apply({ReplaceModule{"/demo/other", "test/narrow"}});
  EXPECT_FALSE(swapped);
  EXPECT_THAT(swapped.diagnostics.ToString(), HasSubstr("8 m is out of bounds"));
}

TEST_F(ValuesPutBack, OfACompositeAreThoseThatAnOutputDoesNotGive) {
  Start(R"(<module name="box" type="test/pair" thread="control"/><connect from="source/value" to="box/a/gain"/>)");
  Say(2);
  EXPECT_EQ(Run("/demo/box/a/parameter/gain"), 2);
  Do({SetParameter{"/demo/box/both", "0"}});
  Do({ReplaceModule{"/demo/box", "test/pair"}});
  EXPECT_EQ(Run("/demo/box/b/parameter/gain"), 0);
}

TEST_F(ValuesPutBack, OfPartsAreNotThoseOfOtherParts) {
  Start(R"(<module name="box" type="test/pair" thread="control"/>)");
  Do({SetParameter{"/demo/box/b/gain", "4"}, ReplaceModule{"/demo/box", "test/pair", {{"gain", "3"}}}});
  EXPECT_EQ(Run("/demo/box/a/parameter/gain"), 3);
  EXPECT_EQ(Run("/demo/box/b/parameter/gain"), 4);
}

TEST_F(ValuesPutBack, OfAnOutputAreSavedAsBeforeWhenASettingIsTakenBack) {
  Start(R"(<module name="other" type="test/source" thread="control"><parameter name="gain" value="1.5"/></module>
    <connect from="source/value" to="other/gain"/>)");
  Say(2);
  EXPECT_EQ(Run(), 2);
  ASSERT_TRUE(history_->Apply({SetParameter{"/demo/other/gain", "5"}}));
  EXPECT_EQ(SavedValue("/demo/other/parameter/gain"), "5");
  ASSERT_TRUE(history_->Undo());
  EXPECT_EQ(Run(), 2);
  EXPECT_EQ(SavedValue("/demo/other/parameter/gain"), "1.5");
}

TEST_F(ValuesPutBack, AreNotWhereARenamingEndsTheProbationWhichIsTold) {
  Start(kOther);
  Do({ReplaceModule{"/demo/other", "test/fragile", {}, 1000}});
  const ChangeOutcome renamed = changes_->Apply({RenameElement{"/demo/other", "another"}});
  EXPECT_THAT(renamed.diagnostics.ToString(), HasSubstr("its probation ends by this"));
  const ChangeOutcome again = changes_->Apply({RenameElement{"/demo/another", "other"}});
  EXPECT_THAT(again.diagnostics.ToString(), ::testing::Not(HasSubstr("probation")));
}

TEST_F(ValuesPutBack, AreInheritedByAFormerNameUnlessThereIsOneOfThatName) {
  Start(R"(<module name="other" type="test/old" thread="control"/>)");
  Do({SetParameter{"/demo/other/boost", "7"}});
  Do({ReplaceModule{"/demo/other", "test/new"}});
  EXPECT_EQ(Run(), 7);
  Do({ReplaceModule{"/demo/other", "test/old"}});
  EXPECT_EQ(Run("/demo/other/parameter/boost"), 7);
  Do({ReplaceModule{"/demo/other", "test/new"}});
  ASSERT_TRUE(history_->Apply({ReplaceModule{"/demo/other", "test/old"}}));
  Do({SetParameter{"/demo/other/boost", "8"}});
  ASSERT_TRUE(history_->Undo());
  EXPECT_EQ(Run(), 8);
}

}  // namespace
}  // namespace runnel::testing

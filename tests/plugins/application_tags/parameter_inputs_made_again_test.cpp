// What outputs have set of the parameters of modules that are made again.

#include <string>
#include <variant>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/plugins/application_tags/made_again_fixture.h"

namespace runnel::testing {
namespace {

TEST_F(MadeAgain, HasWhatAPersonHasSetSince) {
  Start(kConnected);
  Say(2);
  EXPECT_EQ(Run(), 2);
  ASSERT_TRUE(history_->Apply({ReplaceModule{"/demo/other", "test/source"}}));
  Do({SetParameter{"/demo/other/gain", "5"}});
  ASSERT_TRUE(history_->Undo());
  EXPECT_EQ(Run(), 5);
  for (int round = 0; round < 2; ++round) {  // set by a person before, and by the output
    Do({ReplaceModule{"/demo/other", "test/source", {{"gain", "3"}}}});
    EXPECT_EQ(Run(), 3) << "until the next one comes";
    Say(4);
    EXPECT_EQ(Run(), 4);
  }
}

TEST_F(MadeAgain, HasASettingByAFormerName) {
  Start(kConnected);
  Say(2);
  EXPECT_EQ(Run(), 2);
  Do({ReplaceModule{"/demo/other", "test/source", {{"boost", "3"}}}});
  EXPECT_EQ(Run(), 3);
}

// By a person, or by an output that is not connected any more, at a module that fails then.
TEST_F(MadeAgain, HasWhatHasBeenSetAtTheModuleThatHasFailed) {
  Start(kOther);
  for (const bool is_fed : {false, true}) {
    Do({SetParameter{"/demo/other/gain", "5"}});
    Fragile::throws = false;
    Do({ReplaceModule{"/demo/other", "test/fragile", {{"gain", "7"}}, 1000}});
    EXPECT_EQ(Run(), 7);
    if (is_fed) {
      Do({ConnectPorts{"/demo/source/value", "/demo/other/gain"}});
      Say(2);
      EXPECT_EQ(Run(), 2);
      Do({DisconnectPorts{"/demo/source/value", "/demo/other/gain"}});
    }
    Fragile::throws = true;
    Run();
    ASSERT_NE(dynamic_cast<Source*>(*workshop_.runtime.root().Find("/demo/other")), nullptr);
    EXPECT_EQ(Run(), is_fed ? 2 : 5);
  }
}

TEST_F(MadeAgain, HasWhatAnOutputHasSetSince) {
  Start(kConnected);
  Do({SetParameter{"/demo/other/gain", "5"}});
  ASSERT_TRUE(history_->Apply({ReplaceModule{"/demo/other", "test/source"}}));
  Say(2);
  EXPECT_EQ(Run(), 2);
  ASSERT_TRUE(history_->Undo());
  EXPECT_EQ(Run(), 2);
}

TEST_F(MadeAgain, IsSavedWithoutWhatAnOutputHasSet) {
  Start(R"(<module name="other" type="test/source" thread="control"><parameter name="gain" value="1.5"/></module>
    <connect from="source/value" to="other/gain"/>)");
  Say(2);
  EXPECT_EQ(Run(), 2);
  std::string name = "other";
  const auto saved = SavedValue("/demo/other/parameter/gain");
  EXPECT_NE(saved, "2");
  for (const ChangeSet& changes :
       {ChangeSet{ReplaceModule{"/demo/other", "test/source"}}, ChangeSet{SetParameter{"/demo/other/text", "static"}},
        ChangeSet{RenameElement{"/demo/other", "another"}}}) {
    Do(changes);
    if (std::holds_alternative<RenameElement>(changes[0])) name = "another";
    EXPECT_EQ(SavedValue("/demo/" + name + "/parameter/gain"), saved);
    EXPECT_EQ(Run("/demo/" + name + "/parameter/gain"), 2);
  }
}

// What could not be read again would keep the module from being made again.
TEST_F(MadeAgain, HasNoTextThatCannotBeWritten) {
  Start(R"(<module name="named" type="test/named" thread="control"/><connect from="source/label" to="named/label"/>)");
  auto& output = workshop_.Get<Source>("/demo/source").label;
  const auto label = [&] {
    Run();
    return *workshop_.Get<Named>("/demo/named").label.Get();
  };
  output.Publish("good");
  EXPECT_EQ(label(), "good");
  for (const std::string& bad : {std::string("a\x01z"), std::string("a\0z", 3), std::string("\xff")}) {
    output.Publish(bad);
    EXPECT_EQ(label(), "good");
    Do({ReplaceModule{"/demo/named", "test/named"}});
    EXPECT_EQ(label(), "good");
  }
}

TEST_F(MadeAgain, OfAPartIsConnectedAgain) {
  Start(R"(<module name="box" type="test/box" thread="control"/>
    <connect from="source/value" to="box/part/gain"/>)");
  Say(2);
  EXPECT_EQ(Run("/demo/box/part/parameter/gain"), 2);
  Do({ReplaceModule{"/demo/box", "test/box"}});
  EXPECT_EQ(Run("/demo/box/part/parameter/gain"), 2);
  Say(3);
  EXPECT_EQ(Run("/demo/box/part/parameter/gain"), 3);
  EXPECT_FALSE(changes_->Apply({ReplaceModule{"/demo/box", "test/source"}})) << "whose gain is another one";
}

// Of any input with limits.
TEST_F(MadeAgain, ReadsNothingTwice) {
  Start(std::string(kOther) + R"(<module name="stubborn" type="test/stubborn" thread="control"/>
    <module name="goals" type="test/goals" thread="control"><input name="goal" default="1" maximum="10"/></module>
    <connect from="source/value" to="goals/goal"/>)");
  Run();
  Say(2);
  Run();
  Goals::count = 0;
  const ReplaceModule swap{"/demo/goals", "test/goals"};
  EXPECT_FALSE(changes_->Apply({swap, ReplaceModule{"/demo/stubborn", "test/stubborn"}}));
  Run();
  EXPECT_EQ(Goals::count, 0) << "is refused";
  ASSERT_TRUE(history_->Apply({swap}));
  Run();
  ASSERT_TRUE(history_->Undo());
  Run();
  ASSERT_TRUE(history_->Apply({RenameElement{"/demo/goals", "another"}}));
  Run();
  EXPECT_EQ(Goals::count, 0);
  Say(20);
  Run();
  EXPECT_EQ(Goals::count, 0) << "is too much";
  Say(3);
  Run();
  EXPECT_EQ(Goals::count, 1);
}

TEST_F(ParameterInputs, AreConnectedAndTakenOverInOneSet) {
  Build(kModules);
  EXPECT_TRUE(
      Apply({ConnectPorts{"/demo/source/value", "/demo/other/gain"}, ReplaceModule{"/demo/other", "test/source"}}));
  EXPECT_FALSE(workshop_.Get<Port>("/demo/source/output/value").outgoing().empty());
}

}  // namespace
}  // namespace runnel::testing

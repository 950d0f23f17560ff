// Parameters that an output has set, a STOP included, where changes are taken back and modules fail.

#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "tests/plugins/application_tags/made_again_fixture.h"

namespace runnel::testing {
namespace {

INSTANTIATE_TEST_SUITE_P(, Halted, ::testing::Values("stop", "block", "hand", "published"),
                         [](const auto& given) { return given.param; });

TEST_P(Halted, IsNotTakenBackWithAChange) {
  const std::vector<std::pair<ChangeSet, std::string>> all{
      {{ReplaceModule{"/demo/other", "test/source"}}, "other"},
      {{SetParameter{"/demo/other/text", "static"}}, "other"},
      {{RenameElement{"/demo/other", "another"}}, "another"},
      {{DisconnectPorts{"/demo/source/value", "/demo/other/gain"}, ReplaceModule{"/demo/other", "test/source"},
        ConnectPorts{"/demo/source/value", "/demo/other/gain"}},
       "other"}};
  Start(kConnected);
  for (const auto& [changes, name] : all) {
    Resume();
    const std::string renamed = "/demo/" + name + "/parameter/gain";
    ASSERT_TRUE(history_->Apply(changes));
    EXPECT_EQ(Run(renamed), 2);
    Halt();
    EXPECT_EQ(Run(renamed), 0);
    for (int round = 0; round < 2; ++round) {
      ASSERT_TRUE(history_->Undo());
      EXPECT_EQ(Run(), 0) << round;
      ASSERT_TRUE(history_->Redo());
      EXPECT_EQ(Run(renamed), 0) << round;
    }
    ASSERT_TRUE(history_->Undo());
  }
}

TEST_P(Halted, IsNotTakenBackWithASetting) {
  Start(kConnected);
  const std::vector<ChangeSet> all{{SetParameter{"/demo/other/gain", "5"}},
                                   {ReplaceModule{"/demo/other", "test/source", {{"gain", "5"}}}}};
  for (const ChangeSet& changes : all) {
    Resume();
    ASSERT_TRUE(history_->Apply(changes));
    EXPECT_EQ(Run(), 5);
    ASSERT_TRUE(history_->Undo());
    EXPECT_EQ(Run(), 2) << "nothing has come since";
    ASSERT_TRUE(history_->Redo());
    EXPECT_EQ(Run(), 5);
    Halt();
    EXPECT_EQ(Run(), 0);
    ASSERT_TRUE(history_->Undo());
    EXPECT_EQ(Run(), 0);
  }
}

TEST_P(Halted, IsNotTakenBackWithAModuleThatHasFailed) {
  Start(kConnected);
  Say(2);
  EXPECT_EQ(Run(), 2);
  Fail([] {});
}

TEST_P(Halted, IsNotTakenBackThoughConnectedToTheModuleThatHasFailed) {
  Start(kOther);
  Do({SetParameter{"/demo/other/gain", "5"}});
  Say(2);
  EXPECT_EQ(Run(), 5);
  Fail([this] { Do({ConnectPorts{"/demo/source/value", "/demo/other/gain"}}); });
}

TEST_P(Halted, IsNotTakenBackWithTheSettingsBefore) {
  const SetParameter set_5{"/demo/other/gain", "5"}, set_6{"/demo/other/gain", "6"};
  const ReplaceModule swap_5{"/demo/other", "test/source", {{"gain", "5"}}};
  const ReplaceModule swap_6{"/demo/other", "test/source", {{"gain", "6"}}};
  Start(kConnected);
  for (const auto& [first, second] :
       std::vector<std::pair<Change, Change>>{{set_5, set_6}, {set_5, swap_6}, {swap_5, set_6}, {swap_5, swap_6}}) {
    Resume();
    ASSERT_TRUE(history_->Apply({first}));
    Halt();
    EXPECT_EQ(Run(), 0);
    ASSERT_TRUE(history_->Apply({second}));
    EXPECT_EQ(Run(), 6);
    ASSERT_TRUE(history_->Undo());
    EXPECT_EQ(Run(), 0) << "of the output, again";
    ASSERT_TRUE(history_->Undo());
    EXPECT_EQ(Run(), 0);
  }
}

TEST_P(Halted, IsNotTakenBackAfterARefusedChange) {
  Start(std::string(kConnected) + R"(<module name="stubborn" type="test/stubborn" thread="control"/>
    <module name="box" type="test/pair" thread="control"/><connect from="source/value" to="box/b/gain"/>)");
  Resume();
  ASSERT_TRUE(history_->Apply({SetParameter{"/demo/other/gain", "5"}, SetParameter{"/demo/box/b/gain", "5"}}));
  Halt();
  EXPECT_EQ(Run(), 0);
  for (const char* const path : {"/demo/other/gain", "/demo/box/both"})
    EXPECT_FALSE(changes_->Apply({SetParameter{path, "7"}, ReplaceModule{"/demo/stubborn", "test/stubborn"}}));
  EXPECT_EQ(Run(), 0);
  EXPECT_EQ(SavedValue("/demo/other/parameter/gain"), "5") << "what a person has set";
  ASSERT_TRUE(history_->Undo());
  EXPECT_EQ(Run(), 0);
  EXPECT_EQ(Run("/demo/box/b/parameter/gain"), 0);
}

TEST_P(Halted, IsNotTakenBackThoughItWasConnectedDuringTheTrialAlone) {
  Start(kOther);
  for (const char* const value : {"5", "6"}) ASSERT_TRUE(history_->Apply({SetParameter{"/demo/other/gain", value}}));
  Fail([this] {
    Do({ConnectPorts{"/demo/source/value", "/demo/other/gain"}});
    Say(2);
  });
  Do({DisconnectPorts{"/demo/source/value", "/demo/other/gain"}});
  const ChangeOutcome undone = history_->Undo();
  EXPECT_THAT(undone.diagnostics.ToString(), ::testing::HasSubstr("an output has set it"));
  EXPECT_EQ(Run(), 0);
}

TEST_P(Halted, StaysAsAPersonHasSetItThoughTheModuleOnTrialBeganSo) {
  Start(kConnected);
  Resume();
  Do({ReplaceModule{"/demo/other", "test/fragile", {{"gain", "0"}}, 1000}});
  Halt();
  Run();
  for (const char* const value : {"3", "0"}) Do({SetParameter{"/demo/other/gain", value}});
  Fragile::throws = true;
  Run();
  ASSERT_NE(dynamic_cast<Source*>(*workshop_.runtime.root().Find("/demo/other")), nullptr);
  EXPECT_EQ(Run(), 0);
}

TEST_P(Halted, GoesToAParameterThatWasCalledOtherwiseAndBack) {
  Start(R"(<module name="other" type="test/old" thread="control"/><connect from="source/value" to="other/boost"/>)");
  for (const std::uint64_t probation : {0, 1000}) {
    Resume("/demo/other/parameter/boost");
    ASSERT_TRUE(history_->Apply({ReplaceModule{"/demo/other", "test/new", {}, probation}}));
    EXPECT_EQ(Run(), 2);
    Halt();
    EXPECT_EQ(Run(), 0);
    NewName::throws = true;
    if (probation == 0) {
      ASSERT_TRUE(history_->Undo());
    }
    EXPECT_EQ(Run("/demo/other/parameter/boost"), 0);
    EXPECT_FALSE(Output().outgoing().empty());
    NewName::throws = false;
  }
}

TEST_P(Halted, IsKeptByAPartOfWhichNothingIsSet) {
  const std::string part = "/demo/box/b/parameter/gain";
  Start(R"(<module name="box" type="test/pair" thread="control"/><connect from="source/value" to="box/b/gain"/>)");
  Resume(part);
  Halt();
  EXPECT_EQ(Run(part), 0);
  for (const bool is_connected : {true, false}) {
    if (!is_connected) Do({DisconnectPorts{"/demo/source/value", "/demo/box/b/gain"}});
    Do({ReplaceModule{"/demo/box", "test/pair", {{"gain", "3"}}}});
    EXPECT_EQ(Run(part), 0);
    EXPECT_EQ(Run("/demo/box/a/parameter/gain"), 3);
  }
}

TEST_P(Halted, IsNotOvertakenByARedo) {
  for (const ChangeSet& changes : {ChangeSet{SetParameter{"/demo/other/gain", "5"}},
                                   ChangeSet{ReplaceModule{"/demo/other", "test/source", {{"gain", "5"}}}}}) {
    if (!scheduler_) Start(kConnected);
    Resume();
    ASSERT_TRUE(history_->Apply(changes));
    Say(2);
    EXPECT_EQ(Run(), 2);
    ASSERT_TRUE(history_->Undo());
    Halt();
    EXPECT_EQ(Run(), 0);
    ASSERT_TRUE(history_->Redo());
    EXPECT_EQ(Run(), 0);
    ASSERT_TRUE(history_->Undo());
    EXPECT_EQ(Run(), 0);
  }
}

TEST_P(Halted, IsNotTakenBackThoughAnotherHasSetTheSame) {
  Start(kConnected);
  Resume();
  ASSERT_TRUE(history_->Apply({SetParameter{"/demo/other/gain", "5"}}));
  Halt();
  EXPECT_EQ(Run(), 0);
  Do({SetParameter{"/demo/other/gain", "0"}});
  ASSERT_TRUE(history_->Undo());
  EXPECT_EQ(Run(), 0);
}

TEST_P(Halted, StaysThroughACompositeInTheModulesPlace) {
  Start(kOther);
  ASSERT_TRUE(history_->Apply({SetParameter{"/demo/other/gain", "5"}}));
  Do({ConnectPorts{"/demo/source/value", "/demo/other/gain"}});
  Resume();
  Halt();
  EXPECT_EQ(Run(), 0);
  Do({DisconnectPorts{"/demo/source/value", "/demo/other/gain"}});
  ASSERT_TRUE(history_->Apply({ReplaceModule{"/demo/other", "test/pair"}}));
  EXPECT_EQ(Run("/demo/other/a/parameter/gain"), 0);
  for (int undone = 0; undone < 2; ++undone) {
    ASSERT_TRUE(history_->Undo());
    EXPECT_EQ(Run(), 0);
  }
}

TEST_P(Halted, StaysThoughTheModuleOnTrialBeganWithAnother) {
  Start(kConnected);
  Resume();
  Halt();
  EXPECT_EQ(Run(), 0);
  Do({ReplaceModule{"/demo/other", "test/fragile", {{"gain", "9"}}, 1000}});
  Fragile::throws = true;
  Run();
  ASSERT_NE(dynamic_cast<Source*>(*workshop_.runtime.root().Find("/demo/other")), nullptr);
  EXPECT_EQ(Run(), 0);
}

TEST_P(Halted, IsNewerThanWhatIsTakenBackAtAModuleThatIsMadeAgain) {
  Start(kConnected);
  Resume();
  for (const char* const value : {"5", "6"}) ASSERT_TRUE(history_->Apply({SetParameter{"/demo/other/gain", value}}));
  ASSERT_TRUE(history_->Apply({DeleteElement{"/demo/other"}}));
  Halt();
  for (int undone = 0; undone < 3; ++undone) {
    ASSERT_TRUE(history_->Undo());
    EXPECT_EQ(Run(), 0) << undone;
  }
}

// With a unit, and without.
TEST_P(Halted, GoesToWhatHasAnotherUnitAndBack) {
  for (const auto& [first, second] : {std::pair("test/fragile", "test/new"), std::pair("test/new", "test/fragile")}) {
    const std::string type = first;
    if (!scheduler_)
      Start("<module name=\"other\" type=\"" + type +
            R"(" thread="control"/><connect from="source/value" to="other/gain"/>)");
    Do({ReplaceModule{"/demo/other", first}, SetParameter{"/demo/other/gain", "5"}});
    Resume();
    Halt();
    EXPECT_EQ(Run(), 0);
    ASSERT_TRUE(history_->Apply({ReplaceModule{"/demo/other", second}}));
    EXPECT_EQ(Run(), 0);
    ASSERT_TRUE(history_->Undo());
    EXPECT_EQ(Run(), 0);
    Do({ReplaceModule{"/demo/other", second, {}, 1000}});
    Fragile::throws = NewName::throws = true;
    EXPECT_EQ(Run(), 0);
    Fragile::throws = NewName::throws = false;
  }
}

TEST_P(Halted, IsNotTakenBackWithPartsThatWereConnectedOneAfterTheOther) {
  Start(R"(<module name="box" type="test/pair" thread="control"/>)");
  for (const std::string part : {"b", "a"}) {
    Do({ConnectPorts{"/demo/source/value", "/demo/box/" + part + "/gain"}});
    Resume("/demo/box/" + part + "/parameter/gain");
  }
  Do({SetParameter{"/demo/box/both", "5"}});
  Halt();
  EXPECT_EQ(Run("/demo/box/b/parameter/gain"), 0);
  Do({DisconnectPorts{"/demo/source/value", "/demo/box/b/gain"}});
  ASSERT_TRUE(history_->Apply({ReplaceModule{"/demo/box", "test/pair", {{"speed", "5"}}}}));
  ASSERT_TRUE(history_->Undo());
  EXPECT_EQ(Run("/demo/box/b/parameter/gain"), 0);
}

}  // namespace
}  // namespace runnel::testing

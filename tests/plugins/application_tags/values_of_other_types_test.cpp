// Values of parameters where a module of another type takes the place, which has other bounds, defaults, types, units or parts,
// and where that is taken back.

#include <cstdint>
#include <string>

#include <gmock/gmock.h>

#include "tests/plugins/application_tags/other_types_fixture.h"

namespace runnel::testing {
namespace {

using ::testing::HasSubstr;

TEST_F(ValuesOfOtherTypes, AreNotLostWhereTheOneOnTrialRefusesThem) {
  StartWith("one", "gain");
  Set("5");
  Say(0);
  EXPECT_EQ(Run(), 0);
  Swap("high", {{"gain", "7"}}, 1000);
  EXPECT_EQ(Run(), 7);
  High::throws = true;
  Run();
  EXPECT_EQ(Run(), 0);
}

TEST_F(ValuesOfOtherTypes, AreNotLostWhereAnUndoIsOnTrialAndRefusesThem) {
  StartWith("high", "gain");
  Set("5");
  Say(2);
  EXPECT_EQ(Run(), 2);
  Swap("one", {}, 1000);
  ASSERT_TRUE(workshop_.runtime.robot_stop().Press("a test"));
  EXPECT_EQ(Run(), 0);
  EXPECT_THAT(Undo(), HasSubstr("its value is not taken over: 0 is out of bounds"));
  EXPECT_EQ(Run(), 5);
  High::throws = true;
  Run();
  EXPECT_EQ(Run(), 0);
}

TEST_F(ValuesOfOtherTypes, ComeBackWhereTheOneBetweenHasRefusedThem) {
  StartWith("one", "gain");
  Set("5");
  Say(0);
  EXPECT_EQ(Run(), 0);
  Swap("high", {{"gain", "7"}});
  EXPECT_EQ(Run(), 7);
  Undo();
  EXPECT_EQ(Run(), 0);
}

TEST_F(ValuesOfOtherTypes, ComeBackByARedoWhereTheUndoHasRefusedThem) {
  StartWith("high", "gain");
  Set("5");
  Say(2);
  EXPECT_EQ(Run(), 2);
  Swap("one");
  Say(0);
  EXPECT_EQ(Run(), 0);
  Undo();
  EXPECT_EQ(Run(), 5);
  ASSERT_TRUE(history_->Redo());
  EXPECT_EQ(Run(), 0);
}

TEST_F(ValuesOfOtherTypes, ComeBackThoughTheyAreDefaultsOfTheOneBetween) {
  StartWith("one");
  Set("0");
  Swap("none");
  Undo();
  EXPECT_EQ(Run(), 0);
  EXPECT_EQ(SavedValue("/demo/other/parameter/gain"), "0");
  Set("6");
  Swap("none");
  EXPECT_EQ(Run(), 6);
  Set("0");
  Undo();
  EXPECT_EQ(Run(), 0) << "a person has set it since";
}

TEST_F(ValuesOfOtherTypes, AreNotTheDefaultsOfTheOneBetween) {
  StartWith("one", "gain");
  Swap("five");
  EXPECT_EQ(Run(), 5);
  Say(2);
  EXPECT_EQ(Run(), 2);
  Undo();
  EXPECT_EQ(Run(), 2);
  EXPECT_EQ(SavedValue("/demo/other/parameter/gain"), "1");
  Set("1");
  Swap("five");
  EXPECT_EQ(Run(), 1) << "a person has set it";
}

TEST_F(ValuesOfOtherTypes, ComeBackWithAllTheirDigits) {
  StartWith("one");
  Set("0.123456789");
  Swap("coarse");
  Undo();
  EXPECT_EQ(Run(), 0.123456789);
}

TEST_F(ValuesOfOtherTypes, ComeBackWithinTheirBounds) {
  StartWith("metres");
  Set("0.007");
  Swap("centimetres");
  Undo();
  EXPECT_EQ(Run(), 0.007);
}

TEST_F(ValuesOfOtherTypes, ThatAPersonHasSetAgainComeBackThoughTheyWereThereBefore) {
  for (const bool is_default : {false, true}) {
    if (!is_default) StartWith("one", "gain");
    const std::string value = is_default ? "0" : "1";
    Set(value);
    Swap("five");
    Say(2);
    EXPECT_EQ(Run(), 2);
    Set(value);
    Undo();
    EXPECT_EQ(Run(), std::stod(value));
  }
}

TEST_F(ValuesOfOtherTypes, OfAnOutputAreThereWhereTheyCannotBeSetAnyMore) {
  StartWith("fixed");
  Swap("one");
  Do({ConnectPorts{"/demo/source/value", "/demo/other/gain"}});
  Say(2);
  EXPECT_EQ(Run(), 2);
  Say(0);
  EXPECT_EQ(Run(), 0);
  Do({DisconnectPorts{"/demo/source/value", "/demo/other/gain"}});
  Undo();
  EXPECT_EQ(Run(), 0);
}

TEST_F(ValuesOfOtherTypes, ThatWaitWhenTheSwapComesAreThereAgain) {
  StartWith("one", "gain");
  Set("5");
  Say(2);
  EXPECT_EQ(Run(), 2);
  ASSERT_TRUE(workshop_.runtime.robot_stop().Press("a test"));
  Swap("high", {{"gain", "7"}});
  EXPECT_EQ(Run(), 7);
  Undo();
  EXPECT_EQ(Run(), 0);
}

TEST_F(ValuesOfOtherTypes, ThatTheOneBetweenHasRefusedAreReadWhenTheOtherIsBack) {
  StartWith("one", "gain");
  Set("5");
  for (const std::uint64_t trial : {0, 1000}) {
    (void)workshop_.runtime.robot_stop().Release("a test");
    Run();
    Say(2);
    EXPECT_EQ(Run(), 2);
    Swap("high", {{"gain", "7"}}, trial);
    ASSERT_TRUE(workshop_.runtime.robot_stop().Press("a test"));
    EXPECT_EQ(Run(), 7);
    High::throws = trial > 0;
    if (trial == 0) Undo();
    Run();
    EXPECT_EQ(Run(), 0);
  }
}

TEST_F(ValuesOfOtherTypes, ThatAPersonHasSetSinceAreNotOvertakenByARefusedOne) {
  StartWith("one", "gain");
  Swap("high");
  Say(0);
  EXPECT_EQ(Run(), 1);
  Set("3");
  Undo();
  EXPECT_EQ(Run(), 3);
}

TEST_F(ValuesOfOtherTypes, ThatAreDefaultsAgainByUndosAreThoseOfTheNextType) {
  StartWith("one");
  ASSERT_TRUE(history_->Apply({SetParameter{"/demo/other/gain", "3"}}));
  Swap("high");
  Undo();
  Undo();
  EXPECT_EQ(Run(), 1);
  Swap("five");
  EXPECT_EQ(Run(), 5);
}

TEST_F(ValuesOfOtherTypes, SetSinceAndRefusedAreToldAndThoseOfBeforeAreBack) {
  StartWith("high");
  Set("3");
  Swap("one");
  Set("0");
  EXPECT_THAT(Undo(), HasSubstr("its value is not taken over: 0 is out of bounds"));
  EXPECT_EQ(Run(), 3);
}

TEST_F(ValuesOfOtherTypes, ThatAPersonHasSetAreNewerThanWhatWasRefusedBefore) {
  StartWith("high", "gain");
  Say(0);
  EXPECT_EQ(Run(), 1);
  Swap("one");
  EXPECT_EQ(Run(), 0) << "it takes what the other one has refused";
  Say(2);
  EXPECT_EQ(Run(), 2);
  Set("3");
  Undo();
  EXPECT_EQ(Run(), 3);
  ASSERT_TRUE(history_->Redo());
  EXPECT_EQ(Run(), 3);
  Swap("high", {}, 1000);
  Set("4");
  High::throws = true;
  Run();
  EXPECT_EQ(Run(), 4);
}

TEST_F(ValuesOfOtherTypes, ThatASwapSetsAreNewerThanTheOnlyOneThatWasRefused) {
  StartWith("high", "gain");
  Say(0);
  EXPECT_EQ(Run(), 1);
  Swap("one", {{"gain", "7"}});
  EXPECT_EQ(Run(), 7);
  Undo();
  ASSERT_TRUE(history_->Redo());
  EXPECT_EQ(Run(), 7);
}

TEST_F(ValuesOfOtherTypes, RefusedInBetweenAreReadAlsoWhereASettingWasTakenBack) {
  StartWith("one", "gain");
  Set("5");
  Say(2);
  EXPECT_EQ(Run(), 2);
  Swap("high", {{"gain", "7"}});
  ASSERT_TRUE(workshop_.runtime.robot_stop().Press("a test"));
  EXPECT_EQ(Run(), 7);
  ASSERT_TRUE(history_->Apply({SetParameter{"/demo/other/gain", "8"}}));
  Undo();
  Undo();
  EXPECT_EQ(Run(), 0);
}

TEST_F(ValuesOfOtherTypes, RefusedWhereTheyCannotBeSetAnyMoreAreTold) {
  StartWith("fixed_high");
  for (const bool is_given : {false, true}) {
    Swap("one");
    if (is_given) Do({ConnectPorts{"/demo/source/value", "/demo/other/gain"}});
    is_given ? Say(0) : Set("0");
    EXPECT_EQ(Run(), 0);
    if (is_given) Do({DisconnectPorts{"/demo/source/value", "/demo/other/gain"}});
    EXPECT_THAT(Undo(), HasSubstr("its value is not taken over: 0 is out of bounds"));
    EXPECT_EQ(Run(), 1);
  }
}

TEST_F(ValuesOfOtherTypes, ThatAreTheDefaultsOfOthersCountAsSet) {
  StartWith("one");
  ASSERT_TRUE(history_->Apply({SetParameter{"/demo/other/gain", "3"}}));
  Do({ReplaceModule{"/demo/other", "test/five"}});
  Undo();
  EXPECT_EQ(Run(), 1);
  Do({RenameElement{"/demo/other", "another"}});
  EXPECT_EQ(Run("/demo/another/parameter/gain"), 1);
}

TEST_F(ValuesOfOtherTypes, OfAPersonAreThereThoughThatOfAnOutputIsRefused) {
  StartWith("high", "gain");
  Set("10");
  Say(2);
  EXPECT_EQ(Run(), 2);
  Swap("new", {}, 1000);
  Set("3");
  EXPECT_EQ(Run(), 3);
  ASSERT_TRUE(workshop_.runtime.robot_stop().Press("a test"));
  EXPECT_EQ(Run(), 0);
  NewName::throws = true;
  Run();
  EXPECT_EQ(Run(), 3);
}

TEST_F(ValuesOfOtherTypes, RefusedByAnUndoAreThereAgainByARedo) {
  StartWith("high");
  Set("4");
  Swap("one");
  Set("0");
  EXPECT_THAT(Undo(), HasSubstr("0 is out of bounds"));
  EXPECT_EQ(Run(), 4);
  ASSERT_TRUE(history_->Redo());
  EXPECT_EQ(Run(), 0);
}

TEST_F(ValuesOfOtherTypes, RefusedByAnUndoLetThoseOfBeforeCountWithTheirNumbers) {
  StartWith("high", "gain");
  Say(2);
  EXPECT_EQ(Run(), 2);
  Set("5");
  Swap("one");
  Set("20");
  EXPECT_THAT(Undo(), HasSubstr("20 is out of bounds"));
  EXPECT_EQ(Run(), 5);
}

TEST_F(ValuesOfOtherTypes, SetToTheDefaultInBetweenAreSet) {
  StartWith("one");
  Swap("five");
  Set("5");
  Undo();
  EXPECT_EQ(Run(), 5);
}

}  // namespace
}  // namespace runnel::testing

// Values of parameters of composites and their parts, where another type takes the place, and where that is taken back.

#include <string>

#include <gtest/gtest.h>

#include "tests/plugins/application_tags/other_types_fixture.h"

namespace runnel::testing {
namespace {

TEST_F(ValuesOfComposites, OfACompositeAreNotOlderThanWhatAnOutputHasGivenSince) {
  StartWith("front_and_rear");
  Set("5");
  Swap("one", {{"gain", "7"}});
  Do({ConnectPorts{"/demo/source/value", "/demo/other/gain"}});
  for (const double value : {2.0, 0.0}) {
    Say(value);
    EXPECT_EQ(Run(), value);
  }
  Do({DisconnectPorts{"/demo/source/value", "/demo/other/gain"}});
  Set("8");
  EXPECT_EQ(Run(), 8);
  Undo();
  EXPECT_EQ(Run("/demo/other/front/parameter/gain"), 0);
  EXPECT_EQ(Rear(), 0);
}

TEST_F(ValuesOfComposites, OfOnePartAreNotThoseOfAnotherThatSomethingElseStandsFor) {
  StartWith("left_and_right", "left/gain");
  Say(2);
  Run();
  Do({DisconnectPorts{"/demo/source/value", "/demo/other/left/gain"}});
  Do({SetParameter{"/demo/other/right/gain", "0"}});
  Swap("front_and_rear");
  EXPECT_EQ(Run("/demo/other/front/parameter/gain"), 2);
  EXPECT_EQ(Rear(), 0);
  Undo();
  EXPECT_EQ(Run("/demo/other/left/parameter/gain"), 2);
  EXPECT_EQ(Run("/demo/other/right/parameter/gain"), 0);
}

TEST_F(ValuesOfComposites, OfEachPartComeBackFromOneThatHasOneForAll) {
  StartWith("front_and_rear", "front/gain");
  Do({SetParameter{"/demo/other/rear/gain", "0"}});
  Say(2);
  Run();
  Do({DisconnectPorts{"/demo/source/value", "/demo/other/front/gain"}});
  Swap("one");
  EXPECT_EQ(Run(), 2);
  Undo();
  EXPECT_EQ(Run("/demo/other/front/parameter/gain"), 2);
  EXPECT_EQ(Rear(), 0);
  ASSERT_TRUE(history_->Redo());
  Set("8");
  ASSERT_TRUE(history_->Undo());
  EXPECT_EQ(Run("/demo/other/front/parameter/gain"), 8);
  EXPECT_EQ(Rear(), 8);
}

TEST_F(ValuesOfComposites, OfAnOutputComeToAndFromACompositeWithinAComposite) {
  StartWith("one", "gain");
  Set("5");
  Say(0);
  EXPECT_EQ(Run(), 0);
  Do({DisconnectPorts{"/demo/source/value", "/demo/other/gain"}});
  for (const char* const type : {"nested", "one", "nested"}) {
    Swap(type);
    EXPECT_EQ(Run(type == std::string("one") ? "/demo/other/parameter/gain" : "/demo/other/inner/part/parameter/gain"),
              0);
  }
  Undo();
  EXPECT_EQ(Run(), 0);
}

TEST_F(ValuesOfComposites, OfAPartAreNotThoseOfTheSwapThatSetsAnotherNameOfIt) {
  StartWith("left_and_right");
  Set("5");
  Swap("front_and_rear", {{"gain", "7"}});
  EXPECT_EQ(Rear(), 7);
  Undo();
  EXPECT_EQ(Run("/demo/other/left/parameter/gain"), 5);
  EXPECT_EQ(Run("/demo/other/right/parameter/gain"), 5);
}

TEST_F(ValuesOfComposites, ThatNobodyHasSetStayDefaults) {
  StartWith("left_and_right");
  Do({SetParameter{"/demo/other/left/gain", "5"}});
  Swap("one");
  Undo();
  EXPECT_EQ(Run("/demo/other/left/parameter/gain"), 5);
  EXPECT_EQ(Run("/demo/other/right/parameter/gain"), 1);
  Swap("one");
  ASSERT_TRUE(history_->Apply({SetParameter{"/demo/other/gain", "3"}}));
  Swap("high");
  Undo();
  Undo();
  EXPECT_EQ(Run(), 5);
}

TEST_F(ValuesOfComposites, OfWhatIsBesideTheCompositeAreLeftAlone) {
  Start(R"(<module name="third" type="test/one" thread="control"/><module name="other" type="test/beside"/>)");
  Set("4");
  Swap("one");
  Do({SetParameter{"/demo/third/gain", "0"}});
  Undo();
  EXPECT_EQ(Run("/demo/third/parameter/gain"), 0);
}

TEST_F(ValuesOfComposites, OfWhatIsBesideAreNotSetByAChangeThatFails) {
  Start(R"(<module name="third" type="test/one" thread="control"/><module name="other" type="test/one"/>
    <module name="stubborn" type="test/stubborn" thread="control"/>)");
  Set("5");
  Do({SetParameter{"/demo/third/gain", "8"}});
  EXPECT_FALSE(
      changes_->Apply({ReplaceModule{"/demo/other", "test/beside"}, ReplaceModule{"/demo/stubborn", "test/stubborn"}}));
  EXPECT_EQ(Run("/demo/third/parameter/gain"), 8);
  Swap("beside");
  Undo();
  EXPECT_EQ(Run(), 5);
  EXPECT_EQ(Run("/demo/third/parameter/gain"), 8);
}

TEST_F(ValuesOfComposites, OfPartsAreThereAgainByUndosAndRedos) {
  StartWith("left_and_right");
  Do({SetParameter{"/demo/other/right/gain", "3"}});
  Swap("left_and_right");
  const double swapped = Run("/demo/other/right/parameter/gain");
  Undo();
  EXPECT_EQ(Run("/demo/other/right/parameter/gain"), 3);
  ASSERT_TRUE(history_->Redo());
  EXPECT_EQ(Run("/demo/other/right/parameter/gain"), swapped);
  Do({SetParameter{"/demo/other/right/gain", "1"}});
  Undo();
  EXPECT_EQ(Run("/demo/other/right/parameter/gain"), 1);
}

}  // namespace
}  // namespace runnel::testing

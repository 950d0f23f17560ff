#include "core/element/element_path.h"

#include <gmock/gmock.h>

namespace runnel {
namespace {

using testing::ElementsAre;

TEST(SplitPathTest, LeavesOutEmptyParts) {
  EXPECT_THAT(SplitPath("/robot//guard/"), ElementsAre("robot", "guard"));
  EXPECT_THAT(SplitPath("scan"), ElementsAre("scan"));
  EXPECT_TRUE(SplitPath("/").empty());
  EXPECT_TRUE(SplitPath("").empty());
}

TEST(CheckElementNameTest, AcceptsLettersOfAnyLanguageAndSigns) {
  for (const char* name : {"laser", "größe_2", "日本", "?loc", "a?", "\"a\"", "a&b<c>", "a;b#c", "*", "-", "...",
                           "a\\b", "{a=b}", "🤖"}) {
    const auto good = CheckElementName(name);
    EXPECT_TRUE(good) << name << ": " << good.error().message;
  }
}

TEST(CheckElementNameTest, RefusesWhatWouldMakePathsAmbiguous) {
  for (const char* name : {"", ".", "..", "a/b", " a", "a ", "front laser", "a\tb", "a\nb", "a,b"}) {
    EXPECT_FALSE(CheckElementName(name)) << "'" << name << "'";
  }
}

TEST(CheckElementNameTest, RefusesWhatNoFileCanCarry) {
  for (const char* name :
       {"\x01", "a\x1b[2J", "\x7f", "a\xff", "\xc3", "\xc2\x85", "\xef\xbf\xbe", "\xed\xa0\x80", "\xc0\xaf"}) {
    const auto refused = CheckElementName(name);
    ASSERT_FALSE(refused) << "'" << name << "'";
    // Whoever shows the error shows no control character.
    EXPECT_EQ(refused.error().message.find(name), std::string::npos);
  }
  EXPECT_FALSE(CheckElementName(std::string_view("a\0b", 3)));
}

TEST(IsAtOrBelowTest, TakesWholeNamesOnly) {
  EXPECT_TRUE(IsAtOrBelow("/robot/laser", "/robot"));
  EXPECT_TRUE(IsAtOrBelow("/robot", "/robot"));
  EXPECT_TRUE(IsAtOrBelow("/robot", "/robot/"));
  EXPECT_FALSE(IsAtOrBelow("/robot_arm", "/robot"));
  EXPECT_FALSE(IsAtOrBelow("/robot", "/robot/laser"));
  for (const char* root : {"", "/"}) EXPECT_TRUE(IsAtOrBelow("/robot", root));
}

}  // namespace
}  // namespace runnel

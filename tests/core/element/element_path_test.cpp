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

TEST(CheckElementNameTest, AcceptsWordsAndInnerBlanks) {
  EXPECT_TRUE(CheckElementName("front laser"));
  EXPECT_TRUE(CheckElementName("größe_2"));
}

TEST(CheckElementNameTest, RefusesWhatWouldMakePathsAmbiguous) {
  for (const char* name : {"", ".", "..", "a/b", " a", "a ", "a\nb"}) {
    EXPECT_FALSE(CheckElementName(name)) << "'" << name << "'";
  }
}

}  // namespace
}  // namespace runnel

#include <gtest/gtest.h>

#include "plugins/genom_templates/generated_files.h"

namespace runnel::genom {
namespace {

TEST(ThreeWayMergeTest, OneSideChanged) {
  EXPECT_EQ(Merge("a\nb\n", "a\nmine\nb\n", "a\nb\n").text, "a\nmine\nb\n");
  EXPECT_EQ(Merge("a\nb\n", "a\nb\n", "a\nmade\nb\n").text, "a\nmade\nb\n");
  EXPECT_EQ(Merge("a\nb\n", "b\n", "a\nb\n").text, "b\n");
  EXPECT_EQ(Merge("", "", "a\n").text, "a\n");
}

TEST(ThreeWayMergeTest, BothChangedOtherLines) {
  const Merged merged = Merge("a\nb\nc\nd\n", "a\nmine\nb\nc\nd\n", "a\nb\nc\nmade\nd\n");
  EXPECT_EQ(merged.text, "a\nmine\nb\nc\nmade\nd\n");
  EXPECT_EQ(merged.conflicts, 0);
}

TEST(ThreeWayMergeTest, BothChangedTheSameLines) {
  EXPECT_EQ(Merge("a\nb\nc\n", "a\nx\nc\n", "a\nx\nc\n").conflicts, 0);
  const Merged merged = Merge("a\nb\nc\n", "a\nmine\nc\n", "a\nmade\nc\n");
  EXPECT_EQ(merged.conflicts, 1);
  EXPECT_EQ(merged.text, "a\n<<<<<<< yours\nmine\n=======\nmade\n>>>>>>> template\nc\n");
}

TEST(ThreeWayMergeTest, TheEndNeedsNoNewline) {
  EXPECT_EQ(Merge("a\nb", "a\nb", "a\nb\nc").text, "a\nb\nc");
  EXPECT_EQ(Merge("a", "mine", "made").text, "<<<<<<< yours\nmine\n=======\nmade\n>>>>>>> template\n");
}

}  // namespace
}  // namespace runnel::genom

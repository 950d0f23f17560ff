#include <cstdlib>

#include <gtest/gtest.h>

#include "plugins/genom_templates/generated_files.h"

namespace runnel::genom {
namespace {

Merged MergedOf(const std::string& base, const std::string& mine, const std::string& made) {
  const auto merged = Merge(base, mine, made);
  EXPECT_TRUE(merged) << merged.error().ToString();
  return merged ? *merged : Merged{};
}

TEST(ThreeWayMergeTest, OneSideChanged) {
  EXPECT_EQ(MergedOf("a\nb\n", "a\nmine\nb\n", "a\nb\n").text, "a\nmine\nb\n");
  EXPECT_EQ(MergedOf("a\nb\n", "a\nb\n", "a\nmade\nb\n").text, "a\nmade\nb\n");
  EXPECT_EQ(MergedOf("a\nb\n", "b\n", "a\nb\n").text, "b\n");
  EXPECT_EQ(MergedOf("", "", "a\n").text, "a\n");
}

TEST(ThreeWayMergeTest, BothChangedOtherLines) {
  const Merged merged = MergedOf("a\nb\nc\nd\n", "a\nmine\nb\nc\nd\n", "a\nb\nc\nmade\nd\n");
  EXPECT_EQ(merged.text, "a\nmine\nb\nc\nmade\nd\n");
  EXPECT_EQ(merged.conflicts, 0);
}

TEST(ThreeWayMergeTest, BothChangedTheSameLines) {
  EXPECT_EQ(MergedOf("a\nb\nc\n", "a\nx\nc\n", "a\nx\nc\n").conflicts, 0);
  const Merged merged = MergedOf("a\nb\nc\n", "a\nmine\nc\n", "a\nmade\nc\n");
  EXPECT_EQ(merged.conflicts, 1);
  EXPECT_EQ(merged.text, "a\n<<<<<<< yours\nmine\n=======\nmade\n>>>>>>> template\nc\n");
}

TEST(ThreeWayMergeTest, TheLastLineGetsItsEnd) {
  EXPECT_EQ(MergedOf("a\nb", "a\nb", "a\nb\nc").text, "a\nb\nc\n");
  EXPECT_EQ(MergedOf("a", "mine", "made").text, "<<<<<<< yours\nmine\n=======\nmade\n>>>>>>> template\n");
}

TEST(ThreeWayMergeTest, AConflictThatIsThereStillIsNotANewOne) {
  const std::string left = "<<<<<<< yours\nmine\n=======\nmade\n>>>>>>> template\nb\n";
  const Merged merged = MergedOf("a\nb\n", left, "a\nb\nc\n");
  EXPECT_EQ(merged.conflicts, 0);
  EXPECT_EQ(merged.text, left + "c\n");
}

TEST(ThreeWayMergeTest, WithoutTheProgramItSaysWhereThatIs) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  const auto merged = Merge("a\n", "b\n", "c\n");
  setenv("PATH", path.c_str(), 1);
  ASSERT_FALSE(merged);
  EXPECT_EQ(merged.error().hint, "it is in the package diffutils");
}

}  // namespace
}  // namespace runnel::genom

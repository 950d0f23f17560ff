// The rules of the house, held against the source tree that this program was built from.

#include <gmock/gmock.h>

#include "tests/architecture/include_rules.h"
#include "tests/architecture/source_rules.h"

namespace runnel::test {
namespace {

using testing::IsEmpty;

constexpr std::size_t kLargestLibrary = 5000;
constexpr std::size_t kLongestFile = 350;

const SourceTree& Tree() {
  static const SourceTree tree = ReadSourceTree(RUNNEL_SOURCE_FOLDER);
  return tree;
}

TEST(LayeringTest, TheTreeIsThere) {
  EXPECT_TRUE(Tree().contains("CMakeLists.txt"));
  EXPECT_TRUE(Tree().contains("core/port/input.h"));
  EXPECT_GT(Tree().size(), 100u);
}

TEST(LayeringTest, EachPartKnowsOnlyWhatItMayKnow) { EXPECT_THAT(IncludeOffences(Tree(), ProjectRules()), IsEmpty()); }

TEST(LayeringTest, NoPartsKnowEachOtherInACircle) { EXPECT_THAT(Circles(Tree(), ProjectRules()), IsEmpty()); }

TEST(LayeringTest, NoLibraryIsTooLarge) { EXPECT_THAT(TooLargeLibraries(Tree(), kLargestLibrary), IsEmpty()); }

TEST(LayeringTest, NoFileIsTooLong) { EXPECT_THAT(TooLongFiles(Tree(), kLongestFile), IsEmpty()); }

TEST(LayeringTest, TheRootHoldsNothingElse) { EXPECT_THAT(StrayFiles(Tree()), IsEmpty()); }

TEST(LayeringTest, EachLibrarySaysWhatItIs) { EXPECT_THAT(LibrariesWithoutReadme(Tree()), IsEmpty()); }

TEST(LayeringTest, NothingIsLeftOfOneMachineOrUnfinished) { EXPECT_THAT(ForbiddenText(Tree()), IsEmpty()); }

TEST(LayeringTest, EachHeaderIsReadOnce) { EXPECT_THAT(HeadersWithoutGuard(Tree()), IsEmpty()); }

}  // namespace
}  // namespace runnel::test

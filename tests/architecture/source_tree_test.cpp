// What of a folder is the source tree.

#include "tests/architecture/source_tree.h"

#include <cstdlib>
#include <fstream>

#include <gmock/gmock.h>

#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

using testing::ElementsAre;
using testing::Pair;

class SourceTreeTest : public testing::Test {
 protected:
  void Write(const std::string& name) {
    std::filesystem::create_directories((folder_.path() / name).parent_path());
    std::ofstream(folder_.path() / name) << name;
  }
  // False where git is not there.
  bool Git(const std::string& words) {
    return std::system(("git -C '" + folder_.path().string() + "' " + words + " 2>/dev/null").c_str()) == 0;
  }

  TemporaryFolder folder_;
};

TEST_F(SourceTreeTest, IsWhatGitTracks) {
  for (const char* name : {"README.md", "core/port/input.h", "check.log", "core/port/old.orig"}) {
    Write(name);
  }
  if (!Git("init -q")) GTEST_SKIP() << "git is not there";
  ASSERT_TRUE(Git("add README.md core/port/input.h"));
  EXPECT_THAT(ReadSourceTree(folder_.path()),
              ElementsAre(Pair("README.md", "README.md"), Pair("core/port/input.h", "core/port/input.h")));
}

TEST_F(SourceTreeTest, LeavesOutWhatIsTrackedButGone) {
  Write("README.md");
  Write("gone.md");
  if (!Git("init -q") || !Git("add .")) GTEST_SKIP() << "git is not there";
  std::filesystem::remove(folder_.path() / "gone.md");
  EXPECT_THAT(ReadSourceTree(folder_.path()), ElementsAre(Pair("README.md", "README.md")));
}

TEST_F(SourceTreeTest, IsAllThatLiesInAnUnpackedArchive) {
  for (const char* name : {"README.md", "core/port/input.h", "build/core/object.o"}) Write(name);
  EXPECT_THAT(ReadSourceTree(folder_.path()),
              ElementsAre(Pair("README.md", "README.md"), Pair("core/port/input.h", "core/port/input.h")));
}

}  // namespace
}  // namespace runnel::test

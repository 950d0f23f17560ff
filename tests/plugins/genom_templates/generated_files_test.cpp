#include "plugins/genom_templates/generated_files.h"

#include <fstream>

#include <gmock/gmock.h>

#include "core/base/files.h"
#include "tests/support/temporary_folder.h"

namespace runnel::genom {
namespace {

using testing::HasSubstr;
using What = WrittenFile::What;

class GeneratedFilesTest : public testing::Test {
 protected:
  What Write(const std::string& text, bool is_kept, WhatIsThere what_is_there = WhatIsThere::kIsMerged) {
    diagnostics_ = {};
    const auto written = WriteFiles(folder_.path(), {{"sub/file.c", text, is_kept}}, what_is_there, diagnostics_);
    return written.empty() ? What::kConflict : written[0].what;
  }
  void Change(const std::string& text) { std::ofstream(folder_.path() / "sub/file.c") << text; }
  std::string Text() { return TextOfFile(folder_.path() / "sub/file.c").value_or("nothing"); }

  test::TemporaryFolder folder_;
  Diagnostics diagnostics_;
};

TEST_F(GeneratedFilesTest, WhatIsTheSameIsLeftAlone) {
  EXPECT_EQ(Write("a\n", false), What::kNew);
  const auto time = std::filesystem::last_write_time(folder_.path() / "sub/file.c");
  EXPECT_EQ(Write("a\n", false), What::kSame);
  EXPECT_EQ(std::filesystem::last_write_time(folder_.path() / "sub/file.c"), time);
  EXPECT_EQ(Write("b\n", false), What::kReplaced);
}

TEST_F(GeneratedFilesTest, WhatIsKeptKeepsWhatItsUserWrote) {
  EXPECT_EQ(Write("head\nbody\n", true), What::kNew);
  EXPECT_EQ(Write("new head\nbody\n", true), What::kReplaced) << "its user has changed nothing";
  Change("new head\nmy body\n");
  EXPECT_EQ(Write("new head\nbody\n", true), What::kSame);
  EXPECT_EQ(Text(), "new head\nmy body\n");
  Change("new head\nbetween\nbody\nmine\n");
  EXPECT_EQ(Write("newest\nnew head\nbetween\nbody\n", true), What::kMerged);
  EXPECT_EQ(Text(), "newest\nnew head\nbetween\nbody\nmine\n");
  Change("mine\nnew head\nbetween\nbody\n");
  EXPECT_EQ(Write("other\nnew head\nbetween\nbody\n", true), What::kConflict);
  EXPECT_THAT(Text(), HasSubstr("<<<<<<< yours\nmine\n=======\nother\n>>>>>>> template\n"));
}

TEST_F(GeneratedFilesTest, WhatIsThereAndUnknownIsNotTouched) {
  std::filesystem::create_directory(folder_.path() / "sub");
  Change("somebody's\n");
  (void)Write("made\n", true);
  EXPECT_THAT(diagnostics_.ToString(), HasSubstr("sub/file.c: error: this file is there already"));
  EXPECT_EQ(Text(), "somebody's\n");
  EXPECT_EQ(Write("made\n", true, WhatIsThere::kIsOverwritten), What::kReplaced);
}

TEST_F(GeneratedFilesTest, WhatIsAdoptedStaysAndIsMergedWithLaterChanges) {
  std::filesystem::create_directory(folder_.path() / "sub");
  Change("head of somebody\nbody of somebody\n");
  EXPECT_EQ(Write("head\nbody\n", true, WhatIsThere::kIsAdopted), What::kSame);
  EXPECT_EQ(Text(), "head of somebody\nbody of somebody\n");
  EXPECT_EQ(Write("head\nbody\n", true), What::kSame) << diagnostics_.ToString();
  Change("head\nbody of somebody\nfoot\n");
  EXPECT_EQ(Write("head\nnew\nbody\nfoot\n", true, WhatIsThere::kIsAdopted), What::kConflict) << "it is known by now";
}

TEST_F(GeneratedFilesTest, NothingIsWrittenOutsideOfTheFolder) {
  for (const char* path : {"../out", "/tmp/out", ".generated/a", "a/../../out", ""}) {
    Diagnostics diagnostics;
    EXPECT_TRUE(
        WriteFiles(folder_.path(), {{"good", "a", false}, {path, "a", false}}, WhatIsThere::kIsOverwritten, diagnostics)
            .empty())
        << path;
    EXPECT_FALSE(diagnostics.ok());
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "good")) << "all or nothing";
  }
}

}  // namespace
}  // namespace runnel::genom

#include "core/base/program_output.h"

#include <gmock/gmock.h>

#include "core/base/files.h"

namespace runnel {
namespace {

using testing::HasSubstr;

std::vector<std::string> Shell(const std::string& text) { return {"sh", "-c", text}; }

TEST(ProgramOutputTest, IsWhatAProgramWrites) {
  const auto output = OutputOf({.words = {"printf", "%s and $HOME", "one word"}});
  ASSERT_TRUE(output);
  EXPECT_EQ(output->text, "one word and $HOME");  // no shell has seen it
  EXPECT_EQ(output->exit_code, 0);
}

TEST(ProgramOutputTest, SaysHowTheProgramHasEnded) {
  EXPECT_EQ(OutputOf({.words = Shell("exit 3")})->exit_code, 3);
  EXPECT_EQ(OutputOf({.words = Shell("kill -9 $$")})->exit_code, -1);
}

TEST(ProgramOutputTest, HasComplaintsIfTheyAreWanted) {
  const std::vector<std::string> words = Shell("echo bad >&2; echo good");
  EXPECT_EQ(OutputOf({.words = words})->text, "good\n");
  EXPECT_EQ(OutputOf({.words = words, .keeps_complaints = true})->text, "bad\ngood\n");
}

TEST(ProgramOutputTest, IsLongerThanWhatAPipeHolds) {
  EXPECT_EQ(OutputOf({.words = Shell("head -c 300000 /dev/zero")})->text.size(), 300000U);
}

TEST(ProgramOutputTest, ComesFromTheFolderThatIsAskedFor) {
  const auto folder = TemporaryFolder::Make("test");
  ASSERT_TRUE(folder);
  EXPECT_EQ(OutputOf({.words = Shell("pwd -P"), .folder = folder->path()})->text,
            std::filesystem::canonical(folder->path()).string() + "\n");
}

TEST(ProgramOutputTest, IsWithoutInput) { EXPECT_EQ(OutputOf({.words = {"cat"}})->text, ""); }

TEST(ProgramOutputTest, IsNoneOfAProgramThatIsNotThere) {
  const auto output = OutputOf({.words = {"no_program_at_all"}});
  ASSERT_FALSE(output);
  EXPECT_THAT(output.error().message, HasSubstr("no_program_at_all cannot be run: No such file"));
}

}  // namespace
}  // namespace runnel

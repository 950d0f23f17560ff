#include "plugins/parameters/file_path.h"

#include <filesystem>

#include <gtest/gtest.h>

namespace runnel {
namespace {

TEST(FilePath, ReadsAndWritesItsName) {
  EXPECT_EQ(FromText<FilePath>("maps/a b.txt")->text, "maps/a b.txt");
  EXPECT_EQ(TextOf(FilePath{"maps/a b.txt"}), "maps/a b.txt");
  EXPECT_FALSE(FromText<FilePath>(std::string_view("a\0b", 3)));
}

TEST(FilePath, StartsWhereItWasWritten) {
  EXPECT_EQ(ResolvedAgainst("/apps", {"maps/a.txt"}).text, "/apps/maps/a.txt");
  EXPECT_EQ(ResolvedAgainst("/apps", {"../a.txt"}).text, "/a.txt");
  EXPECT_EQ(ResolvedAgainst("", {"a.txt"}).text, "a.txt");
  EXPECT_EQ(ResolvedAgainst("/apps", {"/maps/a.txt"}).text, "/maps/a.txt");
  EXPECT_EQ(ResolvedAgainst("/apps", {""}).text, "");
}

// A file saved under a bare name lies in the folder "": the current one.
TEST(MovedFileNameTest, KnowsTheFolderOfABareName) {
  const std::filesystem::path here = std::filesystem::current_path();
  EXPECT_EQ(MovedFileName("rooms.xml", here / "worlds", ""), "worlds/rooms.xml");
  EXPECT_EQ(MovedFileName("worlds/rooms.xml", "", here / "worlds"), "rooms.xml");
  EXPECT_EQ(MovedFileName("/worlds/rooms.xml", here, ""), "/worlds/rooms.xml");
}

}  // namespace
}  // namespace runnel

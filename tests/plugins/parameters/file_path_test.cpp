#include "plugins/parameters/file_path.h"

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

}  // namespace
}  // namespace runnel

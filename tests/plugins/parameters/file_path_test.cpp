#include "plugins/parameters/file_path.h"

#include <vector>

#include <gtest/gtest.h>

#include "core/types/binary_encoding.h"

namespace runnel {
namespace {

TEST(FilePath, ReadsAndWritesItsName) {
  EXPECT_EQ(FromText<FilePath>("maps/a b.txt")->text, "maps/a b.txt");
  EXPECT_EQ(TextOf(FilePath{"maps/a b.txt"}), "maps/a b.txt");
  EXPECT_FALSE(FromText<FilePath>(std::string_view("a\0b", 3)));
}

TEST(FilePath, SurvivesTheBinaryEncoding) {
  const FilePath file{"maps/a.txt"};
  std::vector<std::byte> bytes;
  ASSERT_TRUE(ToBinary(TypeOf<FilePath>(), &file, bytes));
  FilePath read;
  BinaryReader reader(bytes);
  ASSERT_TRUE(FromBinary(TypeOf<FilePath>(), reader, &read));
  EXPECT_EQ(read, file);
  bytes.pop_back();
  BinaryReader short_reader(bytes);
  EXPECT_FALSE(FromBinary(TypeOf<FilePath>(), short_reader, &read));
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

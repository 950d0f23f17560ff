#include "plugins/mcap/compression.h"

#include <gmock/gmock.h>

namespace runnel::test {
namespace {

std::string Repeated(int count) {
  std::string bytes;
  for (int i = 0; i < count; ++i) bytes += "{\"x\":" + std::to_string(i) + "}";
  return bytes;
}

TEST(Compression, GivesBackWhatItWasGiven) {
  for (const std::string& compression : Compressions()) {
    for (const int count : {0, 1, 10'000}) {
      std::string packed, unpacked;
      const std::string bytes = Repeated(count);
      ASSERT_TRUE(Compress(compression, bytes, packed)) << compression;
      if (count > 100 && !compression.empty()) {
        EXPECT_LT(packed.size(), bytes.size() / 2);
      }
      ASSERT_TRUE(Decompress(compression, packed, bytes.size(), unpacked)) << compression;
      EXPECT_EQ(unpacked, bytes) << compression;
    }
  }
}

TEST(Compression, SaysWhatIsBroken) {
  for (const std::string& compression : Compressions()) {
    std::string packed, unpacked;
    const std::string bytes = Repeated(100);
    ASSERT_TRUE(Compress(compression, bytes, packed));
    EXPECT_FALSE(Decompress(compression, packed, bytes.size() + 1, unpacked)) << compression;
    EXPECT_FALSE(Decompress(compression, packed, bytes.size() - 1, unpacked)) << compression;
    EXPECT_FALSE(
        Decompress(compression, packed.substr(0, packed.size() / 2), bytes.size(), unpacked))
        << compression;
    EXPECT_FALSE(Decompress(compression, "", bytes.size(), unpacked)) << compression;
  }
}

TEST(Compression, NamesThoseThatAreThere) {
  const auto unknown = CheckCompression("rar");
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.error().ToString(), testing::HasSubstr("'rar' is not there"));
  EXPECT_THAT(unknown.error().ToString(), testing::HasSubstr("none"));
}

}  // namespace
}  // namespace runnel::test

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
      std::string compressed, uncompressed;
      const std::string bytes = Repeated(count);
      ASSERT_TRUE(Compress(compression, bytes, compressed)) << compression;
      if (count > 100 && !compression.empty()) {
        EXPECT_LT(compressed.size(), bytes.size() / 2);
      }
      ASSERT_TRUE(Decompress(compression, compressed, bytes.size(), uncompressed)) << compression;
      EXPECT_EQ(uncompressed, bytes) << compression;
    }
  }
}

TEST(Compression, SaysWhatIsBroken) {
  for (const std::string& compression : Compressions()) {
    std::string compressed, uncompressed;
    const std::string bytes = Repeated(100);
    ASSERT_TRUE(Compress(compression, bytes, compressed));
    EXPECT_FALSE(Decompress(compression, compressed, bytes.size() + 1, uncompressed)) << compression;
    EXPECT_FALSE(Decompress(compression, compressed, bytes.size() - 1, uncompressed)) << compression;
    EXPECT_FALSE(Decompress(compression, compressed.substr(0, compressed.size() / 2), bytes.size(), uncompressed))
        << compression;
    EXPECT_FALSE(Decompress(compression, "", bytes.size(), uncompressed)) << compression;
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

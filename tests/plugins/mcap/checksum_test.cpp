#include <string>

#include <gtest/gtest.h>

#include "plugins/mcap/mcap_bytes.h"

namespace runnel::test {
namespace {

TEST(Checksum, IsThatOfIeeeAndZlib) {
  EXPECT_EQ(ChecksumOf(""), 0u);
  EXPECT_EQ(ChecksumOf("123456789"), 0xCBF43926u);  // the check value of the catalogues
  EXPECT_EQ(ChecksumOf("The quick brown fox jumps over the lazy dog"), 0x414FA339u);
}

TEST(Checksum, InPiecesIsThatOfTheWhole) {
  std::string bytes;
  for (int i = 0; i < 1000; ++i) bytes += static_cast<char>(i * 7);
  for (std::size_t cut = 0; cut <= 40; ++cut) {
    Checksum checksum;
    checksum.Add(std::string_view(bytes).substr(0, cut));
    checksum.Add(std::string_view(bytes).substr(cut));
    EXPECT_EQ(checksum.value(), ChecksumOf(bytes)) << cut;
  }
}

}  // namespace
}  // namespace runnel::test

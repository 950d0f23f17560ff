// Files that somebody has changed: they are read as far as they go, and never harm the reader. Run under
// the sanitizers, too.
#include <random>

#include "plugins/mcap/compression.h"
#include "tests/plugins/mcap/mcap_fixture.h"

namespace runnel::test {
namespace {

using HostileFileTest = McapTest;

// How many messages can be read; 0 if the file cannot even be opened. Every error has its place.
std::size_t ReadAsFarAsItGoes(const std::string& file) {
  auto reader = McapReader::Open(file);
  if (!reader) {
    EXPECT_EQ(reader.error().position.file, file);
    return 0;
  }
  const McapContents& contents = (*reader)->contents();
  if (contents.damage) {
    EXPECT_THAT(contents.damage->message, testing::StartsWith("at byte "));
  }
  EXPECT_TRUE(contents.ended_properly || contents.damage);
  std::size_t count = 0;
  for (const McapChunk& chunk : contents.chunks) {
    const auto read = (*reader)->ReadMessages(chunk, [&](const McapMessage&) -> Result<void> {
      ++count;
      return {};
    });
    if (!read) {
      EXPECT_THAT(read.error().message, testing::StartsWith("at byte "));
    }
  }
  for (const auto& place : contents.attachments) (void)(*reader)->ReadAttachment(place);
  return count;
}

TEST_F(HostileFileTest, SurvivesChangedBytes) {
  std::mt19937 random(1);
  for (const std::string& compression : Compressions()) {
    const std::string whole = ReadBytes(WriteFile("whole" + compression, compression, 60));
    for (int i = 0; i < 1500; ++i) {
      std::string bytes = whole;
      const int changes = 1 + static_cast<int>(random() % 4);
      for (int k = 0; k < changes; ++k) {
        // Small and large numbers do more harm than random ones.
        constexpr std::string_view kBad{"\x00\x01\x7f\x80\xff\xfe", 6};
        bytes[random() % bytes.size()] = random() % 2 == 0 ? static_cast<char>(random()) : kBad[random() % kBad.size()];
      }
      WriteBytes(Path("changed"), bytes);
      EXPECT_LE(ReadAsFarAsItGoes(Path("changed")), 60u);
    }
  }
}

TEST_F(HostileFileTest, SurvivesBytesThatAreMissingAddedOrRepeated) {
  std::mt19937 random(2);
  const std::string whole = ReadBytes(WriteFile("whole", "", 60));
  for (int i = 0; i < 1500; ++i) {
    std::string bytes = whole;
    const std::size_t at = random() % bytes.size();
    const std::size_t count = random() % 200;
    if (i % 3 == 0) bytes.erase(at, count);
    if (i % 3 == 1) bytes.insert(at, std::string(count, static_cast<char>(random())));
    if (i % 3 == 2) bytes.insert(at, bytes.substr(random() % bytes.size(), count));
    WriteBytes(Path("changed"), bytes);
    (void)ReadAsFarAsItGoes(Path("changed"));
  }
}

TEST_F(HostileFileTest, SurvivesNoiseBehindTheFirstBytes) {
  std::mt19937 random(3);
  for (int i = 0; i < 500; ++i) {
    std::string bytes(kMcapMagic);
    for (std::size_t k = random() % 400; k > 0; --k) bytes += static_cast<char>(random());
    WriteBytes(Path("noise"), bytes);
    EXPECT_EQ(ReadAsFarAsItGoes(Path("noise")), 0u);
  }
}

TEST_F(HostileFileTest, RefusesAChunkThatWouldNeedAllMemory) {
  const std::string file = WriteFile("whole", "", 10);
  const std::size_t chunk = Must(McapReader::Open(file))->contents().chunks.at(0).offset;
  std::string bytes = ReadBytes(file);
  const std::size_t uncompressed_size = chunk + kMcapRecordHead + 16;
  bytes.replace(uncompressed_size, 8, "\xff\xff\xff\xff\xff\xff\xff\x7f");
  WriteBytes(Path("large"), bytes);
  const auto reader = Must(McapReader::Open(Path("large")));
  ASSERT_TRUE(reader->contents().damage);
  EXPECT_THAT(reader->contents().damage->message, testing::HasSubstr("larger than can be read"));
}

}  // namespace
}  // namespace runnel::test

#include "plugins/mcap/mcap_reader.h"

#include "plugins/mcap/compression.h"
#include "tests/plugins/mcap/mcap_fixture.h"

namespace runnel::test {
namespace {

using testing::HasSubstr;
using testing::SizeIs;
using McapReaderTest = McapTest;

TEST_F(McapReaderTest, ReadsWhatWasWrittenInEachCompression) {
  for (const std::string& compression : Compressions()) {
    auto reader = Must(McapReader::Open(WriteFile("a" + compression, compression, 100)));
    const McapContents& contents = reader->contents();
    EXPECT_TRUE(contents.ended_properly);
    EXPECT_FALSE(contents.damage);
    EXPECT_EQ(contents.header.library, "a test");
    ASSERT_THAT(contents.channels, SizeIs(2));
    EXPECT_EQ(contents.channels.at(0).topic, "/robot/pose");
    EXPECT_EQ(contents.schemas.at(contents.channels.at(0).schema).data, R"({"type":"object"})");
    EXPECT_EQ(contents.channels.at(0).metadata, (McapTexts{{"unit", "m"}}));
    EXPECT_EQ(contents.statistics.messages, 100u);
    EXPECT_EQ(contents.statistics.messages_of.at(1), 20u);
    EXPECT_EQ(contents.statistics.end, 99'000u);
    EXPECT_GT(contents.chunks.size(), 5u);
    EXPECT_EQ(contents.chunks.front().compression, compression);
    EXPECT_EQ(reader->FindMetadata("about")->texts, (McapTexts{{"clock", "simulated"}, {"seed", "7"}}));
    EXPECT_EQ(Must(reader->ReadAttachment(contents.attachments.at(0))), "<application/>\n");
    const auto messages = ReadAll(*reader);
    ASSERT_THAT(messages, SizeIs(100));
    EXPECT_EQ(messages[37], (ReadMessage{0, 37, 37'000, "{\"x\":37}"}));
  }
}

TEST_F(McapReaderTest, TheMessagesOfAChannelComeInTheirOrderWhereChunksOverlap) {
  auto writer = Must(McapWriter::Create(Path("overlap"), {}));
  const std::uint16_t schema = Must(writer->AddSchema("T", "jsonschema", "{}"));
  const std::uint16_t early = Must(writer->AddChannel(schema, "/early", "json", {}));
  const std::uint16_t late = Must(writer->AddChannel(schema, "/late", "json", {}));
  Must(writer->AddMessage({early, 1, 20, 20, "1"}));
  Must(writer->AddMessage({early, 2, 30, 30, "2"}));
  Must(writer->Flush());
  Must(writer->AddMessage({late, 1, 10, 10, "1"}));
  Must(writer->AddMessage({early, 3, 40, 40, "3"}));
  Must(writer->Finish());
  auto reader = Must(McapReader::Open(Path("overlap")));
  std::vector<std::uint64_t> times;
  for (const ReadMessage& each : ReadAll(*reader)) {
    if (each.channel == early) times.push_back(each.time);
  }
  EXPECT_THAT(times, testing::ElementsAre(20u, 30u, 40u));
}

TEST_F(McapReaderTest, OfAKilledFileWhatIsBeforeABrokenChunkIsReadThoughThatBeginsEarlier) {
  auto writer = Must(McapWriter::Create(Path("killed"), {}));
  const std::uint16_t early = Must(writer->AddChannel(0, "/early", "json", {}));
  const std::uint16_t late = Must(writer->AddChannel(0, "/late", "json", {}));
  Must(writer->AddMessage({early, 1, 20, 20, "first"}));
  Must(writer->Flush());
  Must(writer->AddMessage({late, 1, 10, 10, "second"}));
  Must(writer->Flush());
  std::string bytes = ReadBytes(Path("killed"));
  bytes.replace(bytes.find("second"), 6, "broken");
  WriteBytes(Path("broken"), bytes);
  auto reader = Must(McapReader::Open(Path("broken")));
  EXPECT_THAT(reader->contents().damage->message, HasSubstr("checksum"));
  EXPECT_THAT(ReadAll(*reader), testing::ElementsAre(ReadMessage{early, 1, 20, "first"}));
  EXPECT_EQ(reader->contents().statistics.messages, 1u);
}

TEST_F(McapReaderTest, AFileThatWasKilledHasAllButTheLastChunk) {
  for (const std::string& compression : Compressions()) {
    auto reader = Must(McapReader::Open(WriteFile("k" + compression, compression, 100, false)));
    const McapContents& contents = reader->contents();
    EXPECT_FALSE(contents.ended_properly);
    const auto messages = ReadAll(*reader);
    EXPECT_GT(messages.size(), 85u);
    EXPECT_EQ(contents.statistics.messages, messages.size());
    EXPECT_EQ(contents.statistics.end, messages.back().time);
    EXPECT_THAT(contents.damage->message, HasSubstr("the file ends here, before its end"));
  }
}

TEST_F(McapReaderTest, OfAFileCutAnywhereWhatIsBeforeTheCutIsRead) {
  const std::string bytes = ReadBytes(WriteFile("whole", Compressions().front(), 40));
  std::size_t most = 0;
  for (std::size_t size = kMcapMagic.size(); size < bytes.size(); ++size) {
    WriteBytes(Path("cut"), std::string_view(bytes).substr(0, size));
    auto reader = Must(McapReader::Open(Path("cut")));
    EXPECT_FALSE(reader->contents().ended_properly) << size;
    ASSERT_TRUE(reader->contents().damage) << size;
    const std::size_t count = ReadAll(*reader).size();
    EXPECT_GE(count, most) << size;
    most = count;
  }
  EXPECT_EQ(most, 40u);
}

TEST_F(McapReaderTest, SaysWhatIsNoRecording) {
  WriteBytes(Path("elf"),
             "\x7f"
             "ELF\x02\x01\x01\x01\x01");
  const auto elf = McapReader::Open(Path("elf"));
  ASSERT_FALSE(elf);
  EXPECT_THAT(elf.error().message, HasSubstr("begins with 7f 45 4c 46 02 01 01 01, expected 89 4d 43 41 50 30 0d 0a"));
  WriteBytes(Path("empty"), "");
  EXPECT_THAT(McapReader::Open(Path("empty")).error().message, HasSubstr("it is empty"));
  EXPECT_THAT(McapReader::Open(Path("missing")).error().message, HasSubstr("No such file"));
  EXPECT_THAT(McapReader::Open("/").error().message, HasSubstr("it is no file"));
}

TEST_F(McapReaderTest, SaysAtWhichByteWhatWasExpected) {
  std::string bytes = ReadBytes(WriteFile("whole", "", 40));
  // The header record: its opcode, then its length.
  std::string broken = bytes;
  broken[8] = 9;
  WriteBytes(Path("header"), broken);
  EXPECT_EQ(Must(McapReader::Open(Path("header")))->contents().damage->message,
            "at byte 8: expected the header (opcode 1), found opcode 9");
  broken = bytes;
  broken[15] = 1;
  WriteBytes(Path("length"), broken);
  EXPECT_THAT(Must(McapReader::Open(Path("length")))->contents().damage->message,
              testing::MatchesRegex("at byte 8: this record has [0-9]+ bytes, but the file ends "
                                    "[0-9]+ bytes after its head"));
  // A letter of a message.
  broken = bytes;
  const std::size_t character = broken.find("{\"x\":11}");
  broken[character + 1] = 'y';
  WriteBytes(Path("character"), broken);
  auto reader = Must(McapReader::Open(Path("character")));
  const auto read = reader->ReadMessages([](const McapMessage&) -> Result<void> { return {}; });
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().message, HasSubstr("the content of this chunk has the checksum"));
}

TEST_F(McapReaderTest, AnErrorOfWhoUsesTheMessagesEndsTheReading) {
  auto reader = Must(McapReader::Open(WriteFile("a", "", 10)));
  int count = 0;
  const auto read = reader->ReadMessages([&](const McapMessage&) -> Result<void> {
    return ++count == 3 ? Result<void>(Error{.message = "enough"}) : Result<void>();
  });
  EXPECT_EQ(read.error().message, "enough");
  EXPECT_EQ(count, 3);
}

}  // namespace
}  // namespace runnel::test

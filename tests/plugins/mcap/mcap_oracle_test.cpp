// @mcap/core, by the format's authors, reads what we write, and we read what it writes.
#include "tests/plugins/mcap/mcap_oracle.h"

#include <nlohmann/json.hpp>

#include "plugins/mcap/compression.h"
#include "tests/plugins/mcap/mcap_fixture.h"

namespace runnel::test {
namespace {

using Json = nlohmann::json;
using testing::SizeIs;

class McapOracleTest : public McapTest {
 protected:
  void SetUp() override {
    if (const std::string why = WhyNoOracle(); !why.empty()) GTEST_SKIP() << why;
  }
};

TEST_F(McapOracleTest, ReadsOurFilesByIndexAndAsAStreamWithAllChecksums) {
  for (const std::string& compression : Compressions()) {
    const std::string file = WriteFile("ours" + compression, compression, 100);
    const Json said = Json::parse(AskOracle("read.mjs", {file}));
    const Json& indexed = said["indexed"];
    EXPECT_EQ(indexed["profile"], "runnel");
    EXPECT_EQ(indexed["library"], "a test");
    EXPECT_EQ(indexed["statistics"]["messages"], 100);
    EXPECT_EQ(indexed["statistics"]["end"], "99000");
    ASSERT_THAT(indexed["channels"], SizeIs(2));
    EXPECT_EQ(indexed["channels"][0]["topic"], "/robot/pose");
    EXPECT_EQ(indexed["channels"][0]["schemaEncoding"], "jsonschema");
    EXPECT_EQ(indexed["channels"][0]["metadata"]["unit"], "m");
    EXPECT_EQ(indexed["channels"][1]["count"], 20);
    EXPECT_EQ(indexed["metadata"][0]["texts"]["seed"], "7");
    EXPECT_EQ(indexed["attachments"][0]["data"], "<application/>\n");
    ASSERT_THAT(indexed["messages"], SizeIs(100));
    EXPECT_EQ(
        indexed["messages"][37],
        (Json{{"channel", 0}, {"sequence", 37}, {"time", "37000"}, {"publishTime", "37000"}, {"data", "{\"x\":37}"}}));
    EXPECT_EQ(said["streamed"]["messages"], indexed["messages"]);
    EXPECT_TRUE(said["streamed"]["done"]);
    for (const auto& each : indexed["chunks"]) EXPECT_EQ(each, compression);
  }
}

TEST_F(McapOracleTest, ReadsAFileThatWasKilledAsAStream) {
  const std::string file = WriteFile("killed", "", 100, false);
  const Json said = Json::parse(AskOracle("read.mjs", {file, "--streamed-only"}));
  EXPECT_GT(said["streamed"]["messages"].size(), 85u);
  EXPECT_FALSE(said["streamed"]["done"]);
  EXPECT_EQ(said["streamed"]["messages"].size(), ReadAll(*Must(McapReader::Open(file))).size());
}

TEST_F(McapOracleTest, ReadsAnEmptyRecording) {
  auto writer = Must(McapWriter::Create(Path("empty.mcap"), {}));
  Must(writer->Finish());
  const Json said = Json::parse(AskOracle("read.mjs", {Path("empty.mcap")}));
  EXPECT_EQ(said["indexed"]["statistics"]["messages"], 0);
  EXPECT_TRUE(said["streamed"]["done"]);
}

TEST_F(McapOracleTest, WritesFilesThatWeRead) {
  (void)AskOracle("write.mjs", {Path("theirs.mcap")});
  auto reader = Must(McapReader::Open(Path("theirs.mcap")));
  const McapContents& contents = reader->contents();
  EXPECT_TRUE(contents.ended_properly);
  EXPECT_FALSE(contents.damage);
  EXPECT_EQ(contents.header.library, "mcap core");
  EXPECT_EQ(contents.channels.at(0).topic, "/robot/pose");
  EXPECT_EQ(contents.statistics.messages, 50u);
  EXPECT_GT(contents.chunks.size(), 2u);
  EXPECT_EQ(reader->FindMetadata("about")->texts, (McapTexts{{"who", "the oracle"}}));
  EXPECT_EQ(Must(reader->ReadAttachment(contents.attachments.at(0))), "a note");
  const auto messages = ReadAll(*reader);
  ASSERT_THAT(messages, SizeIs(50));
  EXPECT_EQ(messages[14], (ReadMessage{1, 14, 14'000, "{\"x\":14}"}));
}

TEST_F(McapOracleTest, WritesFilesWithoutChunksThatWeRead) {
  (void)AskOracle("write.mjs", {Path("loose.mcap"), "--loose"});
  auto reader = Must(McapReader::Open(Path("loose.mcap")));
  EXPECT_TRUE(reader->contents().ended_properly);
  const auto messages = ReadAll(*reader);
  ASSERT_THAT(messages, SizeIs(50));
  EXPECT_EQ(messages[14], (ReadMessage{1, 14, 14'000, "{\"x\":14}"}));
}

}  // namespace
}  // namespace runnel::test

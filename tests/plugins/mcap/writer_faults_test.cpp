// Wherever memory runs out, what was written before can be read, and nothing is destroyed twice.

#include "plugins/testing/fault_injection.h"
#include "tests/plugins/mcap/mcap_fixture.h"

namespace runnel::test {
namespace {

class WriterFaultsTest : public McapTest {
 protected:
  // Whether it has got to its end.
  bool Write(const std::string& file) {
    try {
      auto writer = McapWriter::Create(file, {.header = {"runnel", "a test"}, .chunk_bytes = 100});
      if (!writer) return false;
      McapWriter& to = **writer;
      const auto schema = to.AddSchema("test::Numbers", "jsonschema", R"({"type":"object"})");
      if (!schema) return false;
      const auto channel = to.AddChannel(*schema, "/some/topic", "json", {{"unit", "metre"}});
      if (!channel) return false;
      const McapMetadata about{"about", {{"clock", "simulated"}}};
      if (!to.AddMetadata(about)) return false;
      for (std::uint32_t i = 0; i < 10; ++i) {
        if (!to.AddMessage({*channel, i, i, i, "{\"x\":\"a number of some length\"}"})) return false;
      }
      return to.Finish().has_value();
    } catch (const std::bad_alloc&) {
      return false;
    }
  }
};

TEST_F(WriterFaultsTest, ARefusalIsToldOrNot) {
  const std::string file = Path("a file whose name is too long for a string.mcap");
  WriteBytes(file, "dear");
  bool is_refused = false;
  const std::size_t points = AtEachPoint(
      InjectedFault::kAllocation,
      [&] {
        try {
          is_refused = !McapWriter::Create(file, {});
        } catch (const std::bad_alloc&) {
          is_refused = true;
        }
      },
      [&](bool) {
        EXPECT_TRUE(is_refused);
        EXPECT_EQ(ReadBytes(file), "dear");
      });
  EXPECT_GT(points, 3u);
}

TEST_F(WriterFaultsTest, WhatWasWrittenCanBeRead) {
  int attempt = 0;
  std::string file = Path("0.mcap");
  bool is_done = false;
  const std::size_t points = AtEachPoint(
      InjectedFault::kAllocation, [&] { is_done = Write(file); },
      [&](bool has_struck) {
        ASSERT_TRUE(is_done || has_struck);
        if (std::filesystem::exists(file)) {
          ASSERT_GT(std::filesystem::file_size(file), 0u);
        }
        if (std::filesystem::exists(file) && std::filesystem::file_size(file) > 0) {
          auto reader = Must(McapReader::Open(file));
          const auto messages = ReadAll(*reader);
          for (std::size_t i = 0; i < messages.size(); ++i) ASSERT_EQ(messages[i].sequence, i);
          EXPECT_EQ(reader->contents().ended_properly, is_done);
          if (is_done) {
            EXPECT_EQ(messages.size(), 10u);
          }
        }
        file = Path(std::to_string(++attempt) + ".mcap");
      });
  EXPECT_GT(points, 20u);
}

}  // namespace
}  // namespace runnel::test

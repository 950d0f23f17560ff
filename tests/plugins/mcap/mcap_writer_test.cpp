#include "plugins/mcap/mcap_writer.h"

#include <csignal>
#include <filesystem>

#include <sys/resource.h>

#include "plugins/mcap/compression.h"
#include "tests/plugins/mcap/mcap_fixture.h"

namespace runnel::test {
namespace {

using testing::HasSubstr;
using McapWriterTest = McapTest;

TEST_F(McapWriterTest, RefusesToWriteOverAFile) {
  WriteBytes(Path("there.mcap"), "dear");
  const auto writer = McapWriter::Create(Path("there.mcap"), {});
  ASSERT_FALSE(writer);
  EXPECT_THAT(writer.error().ToString(), HasSubstr("there.mcap: cannot be made: File exists"));
  EXPECT_EQ(ReadBytes(Path("there.mcap")), "dear");
}

TEST_F(McapWriterTest, SaysThatAFolderIsMissing) {
  const auto writer = McapWriter::Create(Path("no/folder/a.mcap"), {});
  ASSERT_FALSE(writer);
  EXPECT_THAT(writer.error().ToString(), HasSubstr("No such file or directory"));
  EXPECT_THAT(writer.error().hint, HasSubstr("folder"));
}

TEST_F(McapWriterTest, NamesTheCompressionsThatAreThere) {
  EXPECT_FALSE(McapWriter::Create(Path("a.mcap"), {.compression = "rar"}));
  EXPECT_FALSE(std::filesystem::exists(Path("a.mcap")));
}

// A limit on the size of files stands for a full disk: it, too, lets a part of a write through.
TEST_F(McapWriterTest, OfAFullDiskWhatWasWrittenBeforeCanBeRead) {
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 5000;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  auto writer = Must(McapWriter::Create(Path("full.mcap"), {.chunk_bytes = 1000}));
  const auto channel = Must(writer->AddChannel(0, "/number", "json", {}));
  int written = 0;
  Result<void> added;
  while (added && written < 1000) {
    added = writer->AddMessage({channel, 0, static_cast<std::uint64_t>(written++), 0, "12345678"});
  }
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, old_handler);
  ASSERT_FALSE(added);
  EXPECT_THAT(added.error().ToString(), HasSubstr("full.mcap: cannot be written on: File too large"));
  EXPECT_FALSE(writer->AddMessage({channel, 0, 0, 0, "1"})) << "the error stays";
  EXPECT_FALSE(writer->Finish());
  writer.reset();
  auto reader = Must(McapReader::Open(Path("full.mcap")));
  EXPECT_FALSE(reader->contents().ended_properly);
  const auto messages = ReadAll(*reader);
  EXPECT_GT(messages.size(), 20u);
  EXPECT_LT(messages.size(), static_cast<std::size_t>(written));
  EXPECT_THAT(reader->contents().damage->message, HasSubstr("the file ends here"));
}

TEST_F(McapWriterTest, WhatIsFlushedCanBeReadWhileItIsWritten) {
  auto writer = Must(McapWriter::Create(Path("live.mcap"), {}));
  const auto channel = Must(writer->AddChannel(0, "/number", "json", {}));
  Must(writer->AddMessage({channel, 0, 1, 1, "1"}));
  EXPECT_TRUE(ReadAll(*Must(McapReader::Open(Path("live.mcap")))).empty());
  Must(writer->Flush());
  EXPECT_EQ(ReadAll(*Must(McapReader::Open(Path("live.mcap")))).size(), 1u);
  EXPECT_EQ(writer->written_bytes(), std::filesystem::file_size(Path("live.mcap")));
}

TEST_F(McapWriterTest, FinishesOnce) {
  auto writer = Must(McapWriter::Create(Path("a.mcap"), {}));
  Must(writer->Finish());
  const auto size = std::filesystem::file_size(Path("a.mcap"));
  Must(writer->Finish());
  EXPECT_EQ(std::filesystem::file_size(Path("a.mcap")), size);
  EXPECT_TRUE(Must(McapReader::Open(Path("a.mcap")))->contents().ended_properly);
}

}  // namespace
}  // namespace runnel::test

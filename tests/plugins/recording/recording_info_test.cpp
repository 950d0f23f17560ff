#include "plugins/recording/recording_info.h"

#include "tests/plugins/recording/recording_fixture.h"

namespace runnel::test {
namespace {

using testing::HasSubstr;
using RecordingInfoTest = RecordingTest;

TEST_F(RecordingInfoTest, SaysWhatWasRecordedOfWhat) {
  Application application;
  auto recorder = Must(Recorder::Start(
      application.runtime, &application.scheduler,
      {.file = Path("a.mcap"),
       .ports = {"**/sum"},
       .compression = "none",
       .about = {
           .name = "app", .file = "/x/app.xml", .text = "<application/>", .settings = "seed=3", .version = "9.9"}}));
  application.Run(std::chrono::milliseconds(1010));
  Must(recorder->Finish());
  const auto reader = Must(McapReader::Open(Path("a.mcap")));
  const RecordingInfo info = InfoOf(*reader);
  EXPECT_TRUE(info.ended_properly);
  EXPECT_DOUBLE_EQ(info.duration(), 1.0);
  EXPECT_EQ(info.values, 101u);
  EXPECT_EQ(info.compression, "none");
  ASSERT_EQ(info.channels.size(), 1u);
  EXPECT_EQ(info.channels[0].path, "/sink/output/sum");
  EXPECT_EQ(info.channels[0].type, "double");
  EXPECT_DOUBLE_EQ(info.channels[0].rate, 101.0);
  EXPECT_EQ(AboutText(*reader, "settings"), "seed=3");
  EXPECT_EQ(AboutText(*reader, "clock"), "simulated");
  EXPECT_EQ(AboutText(*reader, "version"), "9.9");
  EXPECT_EQ(Must(reader->ReadAttachment(reader->contents().attachments.at(0))), "<application/>");
  const std::string json = RecordingInfoJson(info);
  EXPECT_THAT(json, HasSubstr(R"("duration":1,"ports":1,"values":101,"dropped":0)"));
  EXPECT_THAT(json, HasSubstr(R"({"path":"/sink/output/sum","type":"double")"));
}

TEST_F(RecordingInfoTest, KnowsFilesOfOthers) {
  const auto reader = Must(McapReader::Open(WriteFile("other.mcap", "", 10, false, 20)));
  const RecordingInfo info = InfoOf(*reader);
  EXPECT_FALSE(info.ended_properly);
  ASSERT_TRUE(info.damage);
  EXPECT_EQ(info.library, "a test");
  EXPECT_TRUE(info.about.empty());
  EXPECT_EQ(info.channels.size(), 2u);
  EXPECT_THAT(RecordingInfoJson(info), HasSubstr(R"("ended_properly":false,"damage":"at byte )"));
}

}  // namespace
}  // namespace runnel::test

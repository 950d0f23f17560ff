#include "plugins/tracing/trace_file.h"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

namespace runnel::test {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using ::testing::HasSubstr;

constexpr std::uint64_t kMuch = 1'000'000;

class TraceFileTest : public ::testing::Test {
 protected:
  ~TraceFileTest() override { std::filesystem::remove(path_); }

  TraceFile Make(std::uint64_t most_bytes = kMuch) {
    auto file = TraceFile::Create(path_, most_bytes);
    EXPECT_TRUE(file) << file.error().ToString();
    return std::move(*file);
  }
  std::string Text() {
    std::ifstream stream(path_);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  const std::string path_ =
      ::testing::TempDir() + ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".json";
};

TEST_F(TraceFileTest, IsAnArrayOfEvents) {
  TraceFile file = Make();
  const Time start = file.start();
  file.AddName(3, "\"thread_name\"", "\"name\":\"main\"");
  file.AddSlice(3, "\"cycle\"", "cycle", start + 1'234'567ns, start + 1'234'567ns + 50ns, "\"number\":1");
  file.AddInstant(3, "\"fault\"", "fault", start - 1ns, "");
  ASSERT_TRUE(file.Close());
  const json events = json::parse(Text());
  ASSERT_EQ(events.size(), 3U);
  EXPECT_EQ(events[0]["ph"], "M");
  EXPECT_EQ(events[0]["args"]["name"], "main");
  EXPECT_EQ(events[1]["tid"], 3);
  EXPECT_DOUBLE_EQ(events[1]["ts"], 1234.567);
  EXPECT_DOUBLE_EQ(events[1]["dur"], 0.05);
  EXPECT_EQ(events[1]["args"]["number"], 1);
  EXPECT_DOUBLE_EQ(events[2]["ts"], -0.001);
  EXPECT_EQ(file.events(), 3U);
}

TEST_F(TraceFileTest, IsAnEmptyArrayWithoutEvents) {
  ASSERT_TRUE(Make().Close());
  EXPECT_TRUE(json::parse(Text()).empty());
}

TEST_F(TraceFileTest, IsWholeButForTheLastBracketWhenItIsNotClosed) {
  TraceFile file = Make();
  for (int i = 1; i <= 3; ++i) {
    file.AddInstant(1, "\"x\"", "test", file.start(), "");
    file.Flush();
    EXPECT_EQ(json::parse(Text() + "]").size(), static_cast<std::size_t>(i));
  }
}

TEST_F(TraceFileTest, BecomesNoLongerThanItMayAndCountsWhatIsLeftOut) {
  constexpr std::uint64_t kMost = 20'000;
  TraceFile file = Make(kMost);
  for (int i = 0; i < 1000; ++i) file.AddInstant(1, "\"x\"", "test", file.start(), "");
  EXPECT_GT(file.left_out(), 500U);
  EXPECT_EQ(file.events() + file.left_out(), 1000U);
  file.UseReserve();
  file.AddInstant(1, "\"the end\"", "test", file.start(), "");
  ASSERT_TRUE(file.Close());
  const json events = json::parse(Text());
  EXPECT_EQ(events.size(), file.events());
  EXPECT_EQ(events.back()["name"], "the end");
  EXPECT_LE(Text().size(), kMost + 10);
}

TEST_F(TraceFileTest, SaysWhereItCannotBeWritten) {
  const auto none = TraceFile::Create("/nowhere/trace.json", kMuch);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().position.file, "/nowhere/trace.json");
  EXPECT_THAT(none.error().message, HasSubstr("No such file"));
}

TEST_F(TraceFileTest, SaysAtTheEndWhatCouldNotBeWritten) {
  auto file = TraceFile::Create("/dev/full", kMuch);
  ASSERT_TRUE(file);
  file->AddInstant(1, "\"x\"", "test", file->start(), "");
  file->Flush();
  file->AddInstant(1, "\"x\"", "test", file->start(), "");
  const auto closed = file->Close();
  ASSERT_FALSE(closed);
  EXPECT_THAT(closed.error().message, HasSubstr("No space left"));
  EXPECT_EQ(file->events(), 0U);
  EXPECT_EQ(file->left_out(), 2U);
}

TEST_F(TraceFileTest, IsWholeWhereTheDiskHasBecomeFull) {
  struct rlimit before {};
  getrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_IGN);
  TraceFile file = Make();
  const auto add = [&](int count) {
    for (int i = 0; i < count; ++i) file.AddInstant(1, "\"x\"", "test", file.start(), "");
    file.Flush();
  };
  add(10);
  const struct rlimit until_the_second_event { std::filesystem::file_size(path_) * 23 / 20, before.rlim_max };
  setrlimit(RLIMIT_FSIZE, &until_the_second_event);
  add(10);
  const auto closed = file.Close();
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_DFL);
  EXPECT_FALSE(closed);
  EXPECT_EQ(file.events(), 10U);
  EXPECT_EQ(file.left_out(), 10U);
  EXPECT_EQ(json::parse(Text()).size(), 10U);
}

}  // namespace
}  // namespace runnel::test

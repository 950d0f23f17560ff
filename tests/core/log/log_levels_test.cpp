#include "core/log/log_level.h"
#include "tests/core/log/logger_fixture.h"

namespace runnel::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

class LogLevelsTest : public testing::Test {
 protected:
  void SpeakAll(Speaker& speaker) {
    speaker.log.Debug("d");
    speaker.log.Info("i");
    speaker.log.Warn("w");
    speaker.log.Error("e");
  }
  std::string Heard() {
    std::string heard;
    for (const LogMessage& message : listener.messages()) heard += message.text;
    return heard;
  }

  Runtime runtime;
  Listener listener{runtime};
};

TEST_F(LogLevelsTest, InfoAndMoreIsLoggedUnlessSaidOtherwise) {
  SpeakAll(runtime.Create<Speaker>(runtime.root(), "one"));
  EXPECT_EQ(Heard(), "iwe");
}

TEST_F(LogLevelsTest, CountsForWhatIsThereAndWhatComesLater) {
  auto& before = runtime.Create<Speaker>(runtime.root(), "before");
  SetLogLevel(runtime, "", LogLevel::kWarning);
  SpeakAll(before);
  SpeakAll(runtime.Create<Speaker>(runtime.root(), "after"));
  EXPECT_EQ(Heard(), "wewe");
}

TEST_F(LogLevelsTest, TheLongestPathCounts) {
  auto& robot = runtime.Create<Speaker>(runtime.root(), "robot");
  auto& arm = runtime.Create<Speaker>(robot, "arm");
  auto& other = runtime.Create<Speaker>(runtime.root(), "robot_2");
  SetLogLevel(runtime, "/robot/arm", LogLevel::kDebug);
  SetLogLevel(runtime, "/robot", LogLevel::kOff);
  SpeakAll(robot);
  SpeakAll(arm);
  EXPECT_EQ(Heard(), "diwe");
  SpeakAll(other);
  EXPECT_EQ(Heard(), "diweiwe");
}

TEST_F(LogLevelsTest, WhatIsSetOfAnElementGoesWithIt) {
  auto& robot = runtime.Create<Speaker>(runtime.root(), "robot");
  auto& arm = runtime.Create<Speaker>(robot, "arm");
  for (const char* path : {"", "/robot", "/robot/arm", "/robot_2"}) SetLogLevel(runtime, path, LogLevel::kOff);
  ASSERT_TRUE(runtime.Delete(arm));
  EXPECT_EQ(ReadLogLevels(runtime).size(), 3U);
  ASSERT_TRUE(runtime.Delete(robot));
  EXPECT_THAT(ReadLogLevels(runtime), ElementsAre(Pair("", LogLevel::kOff), Pair("/robot_2", LogLevel::kOff)));
}

TEST_F(LogLevelsTest, CanBeReadAndTakenBack) {
  auto& robot = runtime.Create<Speaker>(runtime.root(), "robot");
  EXPECT_THAT(ReadLogLevels(runtime), IsEmpty());
  SetLogLevel(runtime, "/robot", LogLevel::kError);
  EXPECT_THAT(ReadLogLevels(runtime), ElementsAre(Pair("/robot", LogLevel::kError)));
  EXPECT_FALSE(ResetLogLevel(runtime, "/"));
  EXPECT_TRUE(ResetLogLevel(runtime, "/robot"));
  EXPECT_THAT(ReadLogLevels(runtime), IsEmpty());
  SpeakAll(robot);
  EXPECT_EQ(Heard(), "iwe");
}

// The next runtime may lie at the same address.
TEST_F(LogLevelsTest, GoWithTheirRuntime) {
  alignas(Runtime) std::byte place[sizeof(Runtime)];
  for (int i = 0; i < 2; ++i) {
    auto* const brief = new (place) Runtime;
    EXPECT_THAT(ReadLogLevels(*brief), IsEmpty());
    SetLogLevel(*brief, "", LogLevel::kDebug);
    brief->~Runtime();
  }
}

TEST(LogLevelTest, HasNames) {
  EXPECT_EQ(*LogLevelOf("warning"), LogLevel::kWarning);
  EXPECT_EQ(LogLevelName(LogLevel::kOff), "off");
  const auto wrong = LogLevelOf("warnig");
  ASSERT_FALSE(wrong);
  EXPECT_THAT(wrong.error().ToString(), HasSubstr("there is no log level 'warnig'; did you mean 'warning'?"));
}

}  // namespace
}  // namespace runnel::test

#include "core/log/logger.h"

#include <chrono>
#include <thread>

#include "core/module/module.h"
#include "plugins/testing/guards.h"
#include "tests/core/log/logger_fixture.h"

namespace runnel::test {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

Cycle At(Duration time) { return {.now = Time(time)}; }

class LoggerTest : public testing::Test {
 protected:
  Runtime runtime;
  Listener listener{runtime};
};

TEST_F(LoggerTest, SaysWhoWhenAndHowMuchItMatters) {
  auto& sonar = runtime.Create<Speaker>(runtime.root(), "sonar");
  {
    const CycleScope cycle(At(2s));
    sonar.log.Warn("no echo for {} s", 2.5);
  }
  const auto messages = listener.messages();
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages[0].time, Time(2s));
  EXPECT_EQ(messages[0].level, LogLevel::kWarning);
  EXPECT_EQ(messages[0].path, "/sonar");
  EXPECT_EQ(messages[0].text, "no echo for 2.5 s");
  EXPECT_EQ(messages[0].ToString(), "warning  /sonar: no echo for 2.5 s");
}

TEST_F(LoggerTest, AModuleHasOne) {
  class Talker final : public Module {
   public:
    using Module::Module;
    void Talk() { log().Info("{} things", 3); }

   private:
    void Update() override {}
  };
  runtime.Create<Talker>(runtime.root(), "talker").Talk();
  EXPECT_THAT(listener.lines(), ElementsAre("info     /talker: 3 things"));
}

TEST_F(LoggerTest, NeitherAllocatesNorLocksNorCallsTheSystemInACycle) {
  auto& sonar = runtime.Create<Speaker>(runtime.root(), "sonar");
  PrepareLogging();
  const std::string name = "a name that is longer than what a string keeps in itself";
  const CycleScope cycle(At(1s));
  const AllocationGuard allocations;
  const LockProbe locks;
  SystemCallProbe calls;
  sonar.log.Error("{} of {} at {} says {}", 1, 2u, 0.5, name);
  sonar.log.Debug("unheard {}", name);
  const long call = calls.Stop();
  EXPECT_EQ(allocations.allocations(), 0u);
  EXPECT_EQ(locks.locks(), 0u);
  EXPECT_EQ(call, -1);
}

TEST_F(LoggerTest, MessagesOfSeveralThreadsComeInTheOrderOfTheirTimes) {
  auto& first = runtime.Create<Speaker>(runtime.root(), "first");
  auto& second = runtime.Create<Speaker>(runtime.root(), "second");
  {
    const LogSink hold(runtime, [](const LogMessage&) {});
  }
  std::thread([&] {
    const CycleScope cycle(At(2s));
    second.log.Info("later");
  }).join();
  {
    const CycleScope cycle(At(3s));
    first.log.Info("last");
  }
  const auto lines = listener.lines();
  EXPECT_THAT(lines, ElementsAre("info     /second: later", "info     /first: last"));
}

TEST_F(LoggerTest, WhatIsTooMuchIsLeftOutAndCounted) {
  auto& chatter = runtime.Create<Speaker>(runtime.root(), "chatter");
  for (int i = 0; i < 100; ++i) {
    const CycleScope cycle(At(1s));
    chatter.log.Info("{}", i);
  }
  EXPECT_EQ(listener.messages().size(), 20u);
  {
    const CycleScope cycle(At(1s));
    chatter.log.Error("another level has a measure of its own");
  }
  EXPECT_EQ(listener.messages().size(), 21u);
  const CycleScope cycle(At(2s));
  chatter.log.Info("again");
  EXPECT_EQ(listener.lines().back(), "info     /chatter: again (80 more left out)");
}

TEST_F(LoggerTest, AClockThatIsSetBackFillsNothingAndStopsNothing) {
  auto& chatter = runtime.Create<Speaker>(runtime.root(), "chatter");
  for (int i = 0; i < 30; ++i) {
    const CycleScope cycle(At(100s));
    chatter.log.Info("{}", i);
  }
  {
    const CycleScope cycle(At(1s));
    chatter.log.Info("back");
  }
  EXPECT_EQ(listener.messages().size(), 20u);
  const CycleScope cycle(At(2s));
  chatter.log.Info("a second later");
  EXPECT_EQ(listener.messages().size(), 21u);
}

TEST_F(LoggerTest, WhatADeletedElementHasSaidIsNotLost) {
  auto& sonar = runtime.Create<Speaker>(runtime.root(), "sonar");
  sonar.log.Info("good bye");
  ASSERT_TRUE(runtime.Delete(sonar));
  EXPECT_THAT(listener.lines(), ElementsAre("info     /sonar: good bye"));
}

TEST_F(LoggerTest, TwoRuntimesHearOnlyTheirOwn) {
  Runtime other;
  Listener other_listener(other);
  runtime.Create<Speaker>(runtime.root(), "here").log.Info("one");
  other.Create<Speaker>(other.root(), "there").log.Info("two");
  EXPECT_THAT(listener.lines(), ElementsAre("info     /here: one"));
  EXPECT_THAT(other_listener.lines(), ElementsAre("info     /there: two"));
}

TEST_F(LoggerTest, ASinkThatThrowsDisturbsNoOther) {
  const LogSink thrower(runtime, [](const LogMessage&) { throw std::runtime_error("full"); });
  Listener another(runtime);
  runtime.Create<Speaker>(runtime.root(), "sonar").log.Info("heard");
  EXPECT_EQ(another.lines().size(), 1u);
  EXPECT_EQ(listener.lines().size(), 1u);
}

// What a thread has no room for is told as a number; nobody reads meanwhile.
TEST(LoggerRingTest, WhatFindsNoRoomIsCounted) {
  Runtime runtime;
  auto& chatter = runtime.Create<Speaker>(runtime.root(), "chatter");
  const std::string long_text(400, 'x');
  for (int i = 0; i < 400; ++i) {
    const CycleScope cycle(At(i * 1s));
    chatter.log.Info("{}", long_text);
  }
  Listener listener(runtime);
  const auto messages = listener.messages();
  ASSERT_GT(messages.size(), 100u);
  EXPECT_EQ(messages.back().level, LogLevel::kWarning);
  EXPECT_EQ(messages.back().text,
            std::to_string(400 - (messages.size() - 1)) + " messages were lost: the log is read too slowly");
}

// For ThreadSanitizer: a part of the runtime that several threads work for has one.
TEST_F(LoggerTest, SeveralThreadsSpeakByOneLogger) {
  constexpr int kEach = 50;
  auto& shared = runtime.Create<Speaker>(runtime.root(), "shared");
  std::vector<std::thread> threads;
  for (int number = 0; number < 3; ++number) {
    threads.emplace_back([&shared, number] {
      const CycleScope cycle(At(1s));
      for (int i = 0; i < kEach; ++i) shared.log.Info("{} {}", number, i);
    });
  }
  for (auto& thread : threads) thread.join();
  const CycleScope cycle(At(10s));
  shared.log.Info("last");
  const auto messages = listener.messages();
  EXPECT_GT(messages.size(), 1u);
  EXPECT_LE(messages.size(), 21u) << "the measure is the element's, whoever speaks for it";
  std::uint64_t all = messages.size();
  for (const LogMessage& message : messages) all += message.left_out;
  EXPECT_EQ(all, 3u * kEach + 1);
}

// For ThreadSanitizer: rings change hands, elements go, sinks come and go meanwhile.
TEST_F(LoggerTest, ManyThreadsSpeakWhileElementsAndSinksComeAndGo) {
  std::vector<std::thread> threads;
  for (int number = 0; number < 4; ++number) {
    threads.emplace_back([this, number] {
      for (int round = 0; round < 20; ++round) {
        auto& speaker = runtime.Create<Speaker>(runtime.root(), "t" + std::to_string(number));
        std::thread([&] {
          for (int i = 0; i < 5; ++i) speaker.log.Info("{} {}", round, i);
        }).join();
        SetLogLevel(runtime, "/t0", LogLevel::kDebug);
        const LogSink brief(runtime, [](const LogMessage&) {});
        ASSERT_TRUE(runtime.Delete(speaker));
      }
    });
  }
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(listener.messages().size(), 4u * 20 * 5);
}

}  // namespace
}  // namespace runnel::test

// Cycles on both clocks, and what is told of them.

#include <atomic>
#include <thread>

#include <gmock/gmock.h>

#include "core/log/log_sink.h"
#include "plugins/application/run_report.h"
#include "plugins/command_service/application_log.h"
#include "tests/plugins/application/counting_modules.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

double Newest(Application& application, std::string_view path) {
  return application.Read<double>(path).value().value_or(0);
}

TEST(ApplicationRunning, RunsSoManyCycles) {
  const auto application = LoadCounting(kCounting);
  ASSERT_TRUE(application->RunCycles(5));
  EXPECT_EQ(Newest(*application, "/source/count"), 5);
  EXPECT_EQ(Newest(*application, "/judge/out"), -1005);
}

TEST(ApplicationRunning, RunsToATimeOfItsClock) {
  const auto application = LoadCounting(kCounting);
  ASSERT_TRUE(application->RunFor(100ms));
  EXPECT_EQ(Newest(*application, "/source/count"), 10);
  ASSERT_TRUE(application->RunFor(50ms));
  EXPECT_EQ(Newest(*application, "/source/count"), 15);
}

TEST(ApplicationRunning, CannotBeSteppedOnARealClock) {
  const auto application = LoadCounting(CountingInRealTime());
  EXPECT_THAT(application->RunCycles(1).error().ToString(), HasSubstr("call Start() and Stop()"));
  EXPECT_THAT(application->RunFor(1s).error().ToString(), HasSubstr("real time"));
}

TEST(ApplicationRunning, RunsUntilItIsStoppedAndAgain) {
  for (const std::string& text : {std::string(kCounting), CountingInRealTime()}) {
    const auto application = LoadCounting(text);
    ASSERT_TRUE(application);
    for (int round = 0; round < 3; ++round) {
      const double before = Newest(*application, "/source/count");
      ASSERT_TRUE(application->Start());
      EXPECT_TRUE(application->is_running());
      EXPECT_FALSE(application->Start()) << "it runs already";
      EXPECT_FALSE(application->Run()) << "it runs already";
      WaitUntil("some cycles have run", [&] { return Newest(*application, "/source/count") > before + 3; });
      application->Stop();
      EXPECT_FALSE(application->is_running());
    }
    const double after = Newest(*application, "/source/count");
    std::this_thread::sleep_for(30ms);
    EXPECT_EQ(Newest(*application, "/source/count"), after);
  }
}

TEST(ApplicationRunning, IsPausedAndSteppedWhileItRuns) {
  const auto application = LoadCounting(kCounting, {.is_paused = true});
  EXPECT_THAT(application->RunCycles(1).error().ToString(), HasSubstr("is paused"));
  ASSERT_TRUE(application->Start());
  ASSERT_TRUE(application->Step(4));
  WaitUntil("four cycles have run", [&] { return Newest(*application, "/source/count") >= 4; });
  EXPECT_EQ(Newest(*application, "/source/count"), 4);
  ASSERT_TRUE(application->Resume());
  WaitUntil("time goes on", [&] { return Newest(*application, "/source/count") > 10; });
  ASSERT_TRUE(application->Pause());
}

TEST(ApplicationRunning, EndsWithTheVerdictOfItsMonitors) {
  for (const std::string& text : {std::string(kCounting), CountingInRealTime()}) {
    const auto application = LoadCounting(text, {.settings = {{"enough", "1007"}}});
    const auto ran = application->Run({.limit = 30s});
    ASSERT_TRUE(ran);
    EXPECT_TRUE(application->report().IsOver());
    EXPECT_TRUE(application->report().IsGood());
    EXPECT_EQ(application->report().Verdicts(), "enough\n");
  }
}

TEST(ApplicationRunning, EndsWithALimitOrWhenSomebodySaysSo) {
  const auto application = LoadCounting(kCounting);
  EXPECT_EQ(application->Run({.limit = 200ms}).value(), 200ms);
  EXPECT_EQ(Newest(*application, "/source/count"), 20);
  const auto ran = application->Run({.is_over = [](Duration so_far) { return so_far >= 30ms; }});
  EXPECT_EQ(ran.value(), 30ms);
}

TEST(ApplicationRunning, WithNothingToRunIsAnError) {
  const auto application = Application::Compose("empty");
  EXPECT_THAT(application->Run().error().ToString(), HasSubstr("there is nothing to run"));
}

// From loading on, in order, with the times of the application's clock.
TEST(ApplicationRunning, TellsWhatModulesSay) {
  const auto lines = [](const std::string& level) {
    const auto application = LoadCounting(R"(<application name="talk">
      <clock type="simulated" speed="0"/> <thread name="main" period="10ms"/>)" +
                                          level + R"(<module name="talker" type="counting/talker"/>
      </application>)");
    EXPECT_TRUE(application) << application.diagnostics().ToString();
    EXPECT_TRUE(application->RunCycles(3));
    FlushLog();
    std::string events;
    for (const auto& event : application->TakeEvents()) {
      EXPECT_EQ(event.kind, ApplicationEvent::Kind::kMessage);
      events += event.text;
    }
    std::string entries;
    for (const auto& entry : application->log().ReadEntries(0, 10).entries) {
      entries += std::string(ApplicationLog::KindName(entry.kind)) + " " + entry.text + "\n";
    }
    EXPECT_EQ(application->log().faults(), 0u);
    return std::pair(events, entries);
  };
  EXPECT_EQ(lines(""), std::pair(std::string("       0s  info     /talk/talker: ready\n"
                                             "     10ms  warning  /talk/talker: no echo for 2.5 s\n"),
                                 std::string("info /talk/talker: ready\n"
                                             "warning /talk/talker: no echo for 2.5 s\n")));
  EXPECT_EQ(lines("<log level='warning' of='talker'/>").second, "warning /talk/talker: no echo for 2.5 s\n");
  EXPECT_EQ(lines("<log level='debug'/>").second,
            "info /talk/talker: ready\ndebug /talk/talker: cycle 1\ndebug /talk/talker: cycle 2\n"
            "warning /talk/talker: no echo for 2.5 s\ndebug /talk/talker: cycle 3\n");
}

TEST(ApplicationRunning, TellsOfFaults) {
  const auto application = LoadCounting(kCounting, {.settings = {{"limit", "1003"}}});
  ASSERT_TRUE(application->RunCycles(6));
  const auto events = application->TakeEvents();
  ASSERT_THAT(events, SizeIs(1));
  EXPECT_EQ(events[0].kind, ApplicationEvent::Kind::kFault);
  EXPECT_THAT(events[0].text, HasSubstr("/counting/judge: has failed: that is too much"));
  ASSERT_TRUE(events[0].fault);
  EXPECT_EQ(events[0].fault->path, "/counting/judge");
  EXPECT_THAT(application->TakeEvents(), IsEmpty());
  EXPECT_THAT(application->log().ReadEntries(0, 10).entries, SizeIs(1));
  EXPECT_EQ(Newest(*application, "/source/count"), 6) << "the rest runs on";
}

TEST(ApplicationRunning, TwoInOneProcessOnDifferentClocksKnowNothingOfEachOther) {
  const auto simulated = LoadCounting(kCounting, {.settings = {{"factor", "2"}}});
  const auto real = LoadCounting(CountingInRealTime(), {.settings = {{"factor", "-1"}}});
  ASSERT_TRUE(simulated && real);
  ASSERT_TRUE(real->Start());
  ASSERT_TRUE(simulated->Start());
  WaitUntil("both have run",
            [&] { return Newest(*simulated, "/source/count") > 10 && Newest(*real, "/source/count") < -5; });
  simulated->Stop();
  const double at = Newest(*real, "/source/count");
  WaitUntil("the other one goes on", [&] { return Newest(*real, "/source/count") < at; });
  EXPECT_TRUE(simulated->Set("/source/factor", "0.5"));
  EXPECT_EQ(real->Get("/source/factor").value(), "-1");
}

}  // namespace
}  // namespace runnel::test

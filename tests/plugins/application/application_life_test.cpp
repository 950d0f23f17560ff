// The end of an application in each of its states, also with clients attached.

#include <thread>

#include <sys/stat.h>

#include <gmock/gmock.h>

#include "tests/plugins/application/counting_modules.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

using namespace std::chrono_literals;

TEST(ApplicationLife, EndsInWhicheverStateItIs) {
  for (const std::string& text : {std::string(kCounting), CountingInRealTime()}) {
    const bool is_simulated = text == kCounting;
    { const auto loaded = LoadCounting(text); }
    {
      const auto running = LoadCounting(text);
      ASSERT_TRUE(running->Start());
    }
    {
      const auto stopped = LoadCounting(text);
      ASSERT_TRUE(stopped->Start());
      stopped->Stop();
    }
    if (is_simulated) {
      const auto paused = LoadCounting(text, {.is_paused = true});
      ASSERT_TRUE(paused->Start());
    }
    {
      const auto by_itself = LoadCounting(text);
      ASSERT_TRUE(by_itself->Start());
      by_itself->RequestStop();
      WaitUntil("it has stopped by itself", [&] { return !by_itself->is_running(); });
    }
    {
      const auto tied = LoadCounting(text);
      ASSERT_TRUE(tied->InputFrom<double>("/judge/out", {.queue = 4}));
      ASSERT_TRUE(tied->OutputTo<double>("/judge/in"));
      ASSERT_TRUE(tied->Start());
    }
  }
}

TEST(ApplicationLife, ValuesThatWereReadOutliveIt) {
  Lease<double> kept;
  {
    const auto application = LoadCounting(kCounting);
    const auto input = application->InputFrom<double>("/source/count");
    ASSERT_TRUE(application->RunCycles(3));
    kept = (*input)->Read();
  }
  ASSERT_TRUE(kept);
  EXPECT_EQ(*kept, 3);
}

TEST(ApplicationLife, IsChangedByOneThreadWhileItRunsAndReadByAnother) {
  const auto application = LoadCounting(CountingInRealTime());
  ASSERT_TRUE(application->Start());
  std::jthread reader([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) (void)application->Read<double>("/judge/out");
  });
  for (int round = 0; round < 20; ++round) {
    const auto outcome =
        application->Swap("/judge", round % 2 == 0 ? "counting/filter" : "counting/judge");
    ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
  }
  reader.request_stop();
}

// Nobody writes into it: who read it would wait for ever.
TEST(ApplicationLife, APipeInThePlaceOfAFileIsNotRead) {
  const TemporaryFolder folder;
  const auto pipe = folder.path() / "pipe.xml";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const auto application = Application::LoadText("<application name=\"robot\"/>", {});
  ASSERT_TRUE(application) << application.diagnostics().ToString();
  const auto saved = application->Save(pipe);
  ASSERT_FALSE(saved);
  EXPECT_THAT(saved.error().message, testing::HasSubstr("is no file"));
  EXPECT_FALSE(application->service().application().hooks.preview_save(pipe.string()));
}

}  // namespace
}  // namespace runnel::test

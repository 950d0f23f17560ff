// The end of an application in each of its states, also with clients attached.

#include <atomic>
#include <functional>
#include <semaphore>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <sys/stat.h>

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
    const auto outcome = application->Swap("/judge", round % 2 == 0 ? "counting/filter" : "counting/judge");
    ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
  }
  reader.request_stop();
}

/// Its constructor waits, once the test has said so.
class CountingSlow final : public Module {
 public:
  explicit CountingSlow(const Placement& placement) : Module(placement) {
    if (!is_slow) return;
    begun.release();
    may_end.acquire();
  }
  static inline std::atomic<bool> is_slow{false};
  static inline std::binary_semaphore begun{0};
  static inline std::binary_semaphore may_end{0};

 private:
  void Update() override {}
};

class ApplicationWithSlow : public testing::Test {
 protected:
  ApplicationWithSlow()
      : application(Application::LoadFrom([](const BuildTools& tools) {
          AddCountingTypes(tools.plugins);
          AddType<CountingSlow>(tools.plugins, "counting/slow");
          const auto document = XmlDocument::Parse(kText, "slow.xml");
          return BuildApplication(*document, "", tools, BuildMode::kConstruct);
        })) {
    CountingSlow::is_slow = true;
  }
  ~ApplicationWithSlow() override { CountingSlow::is_slow = false; }
  static constexpr const char* kText = R"(<application name="robot">
    <clock type="simulated" speed="0"/> <thread name="main" period="10ms"/>
    <module name="slow" type="counting/slow"/> <module name="source" type="counting/source"/>
    <module name="judge" type="counting/judge"/> </application>)";
  LoadedApplication application;
};

// A save looks at all plugins that are there, and builds the application once more to see whether its text would load.
TEST_F(ApplicationWithSlow, NoPluginIsLoadedWhileASaveIsUnderWay) {
  const TemporaryFolder folder;
  std::jthread saves([&] { EXPECT_TRUE(application->Save(folder.path() / "saved.xml")); });
  CountingSlow::begun.acquire();
  CountingSlow::is_slow = false;
  std::atomic<int> loaded{0};
  std::vector<std::jthread> load;
  load.emplace_back([&] { loaded += application->Swap("/judge", "nowhere/judge") ? 0 : 1; });
  load.emplace_back([&] { loaded += application->Apply({CreateModule{"/a", "nowhere/judge"}}) ? 0 : 1; });
  load.emplace_back([&] { loaded += application->CreateModule("nowhere/judge", "b") ? 0 : 1; });
  std::this_thread::sleep_for(100ms);  // in which they would be over, if they did not wait
  EXPECT_EQ(loaded, 0);
  CountingSlow::may_end.release();
  load.clear();
  EXPECT_EQ(loaded, 3) << "there is no such plugin";
}

TEST_F(ApplicationWithSlow, WhatWasAskedForBeforeAStopIsNotDoneAfterIt) {
  RobotStop& stop = application->runtime().robot_stop();
  const auto over = [&](const std::function<ChangeOutcome()>& change) {
    ChangeOutcome outcome;
    CountingSlow::is_slow = true;
    std::jthread changes([&] { outcome = change(); });
    CountingSlow::begun.acquire();
    CountingSlow::is_slow = false;
    stop.Press("a test");
    EXPECT_TRUE(stop.Release("a test"));
    CountingSlow::may_end.release();
    changes.join();
    EXPECT_THAT(outcome.diagnostics.ToString(),
                testing::HasSubstr("STOP was pressed or released after this was asked for"));
    return outcome.is_done;
  };
  EXPECT_FALSE(over([&] { return application->Apply("connect /source/count /judge/in; create /new counting/slow"); }));
  EXPECT_FALSE(application->Find<CountingSlow>("/new"));
  EXPECT_FALSE(over([&] { return application->Swap("/judge", "counting/slow"); }));
  EXPECT_TRUE(application->Find<CountingJudge>("/judge"));
  ASSERT_TRUE(application->Apply("delete /slow"));
  EXPECT_FALSE(over([&] { return application->Undo(); }));
  EXPECT_FALSE(application->Find<CountingSlow>("/slow"));
  EXPECT_TRUE(application->Undo()) << "it is not forgotten";
  EXPECT_TRUE(application->Find<CountingSlow>("/slow"));
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

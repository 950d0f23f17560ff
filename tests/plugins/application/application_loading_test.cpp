// From a text, settings and extensions to an application that is ready, or to all that is wrong.

#include <filesystem>
#include <fstream>
#include <memory>

#include <gmock/gmock.h>

#include "plugins/application/application_extension.h"
#include "plugins/testing/fault_injection.h"
#include "tests/plugins/application/counting_modules.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(ApplicationLoading, TakesSettingsAndIsReadyWhenItIsThere) {
  const auto application = LoadCounting(kCounting, {.settings = {{"factor", "2"}}});
  ASSERT_TRUE(application) << application.diagnostics().ToString();
  EXPECT_EQ(application->name(), "counting");
  EXPECT_EQ(application->Get("/source/factor").value(), "2");
  EXPECT_EQ(application->element().life_cycle(), LifeCycle::kReady);
  EXPECT_FALSE(application->is_running());
}

TEST(ApplicationLoading, TellsAllThatIsWrongOfTextAndSettingsAtOnce) {
  const auto application = LoadCounting(
      R"(<application name="counting">
  <module name="source" type="counting/sorce"/>
  <module name="filter" type="counting/filter"><parameter name="gain" value="1"/></module>
</application>)",
      {.settings = {ApplicationSetting("nothing"), {"factr", "3"}}});
  ASSERT_FALSE(application);
  const std::string text = application.diagnostics().ToString();
  EXPECT_THAT(text, HasSubstr("counting.xml:2:"));
  EXPECT_THAT(text, HasSubstr("did you mean 'counting/source'?"));
  EXPECT_THAT(text, HasSubstr("there is no parameter 'gain'"));
  EXPECT_THAT(text, HasSubstr("'nothing'"));
  EXPECT_THAT(text, HasSubstr("knows no 'factr'"));
}

TEST(ApplicationLoading, SaysWhatCannotBePreparedWithItsPlace) {
  const auto application = LoadCounting(kCounting, {.settings = {{"label", "broken"}}});
  ASSERT_FALSE(application);
  EXPECT_EQ(application.diagnostics().ToString(), "counting.xml:3:3: error: /counting/source: it is broken\n");
}

TEST(ApplicationLoading, OfAFileThatIsNotThereIsAnError) {
  const auto application = Application::Load("/no/such/file.xml");
  ASSERT_FALSE(application);
  EXPECT_THAT(application.error().ToString(), HasSubstr("/no/such/file.xml"));
}

TEST(ApplicationLoading, ReadsAFileAndRemembersWhereItWas) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "empty.xml";
  std::ofstream(file) << "<application name=\"empty\"/>";
  const auto application = Application::Load(file);
  ASSERT_TRUE(application) << application.diagnostics().ToString();
  EXPECT_EQ(application->file(), file.string());
  EXPECT_EQ(application->text(), "<application name=\"empty\"/>");
}

TEST(ApplicationLoading, RefusesASpeedOfRealTime) {
  const auto application = LoadCounting(CountingInRealTime(), {.speed = 2});
  ASSERT_FALSE(application);
  EXPECT_THAT(application.error().ToString(), HasSubstr("/counting: the speed of real time cannot be chosen"));
}

// Notes when it is called; throws or fails at one of its calls.
class Notes final : public ApplicationExtension {
 public:
  std::vector<std::string> calls;
  std::string fails_at;
  bool throws_number = false;

  Result<void> Prepare(FrameworkElement& application, SchedulerOptions&) override {
    EXPECT_EQ(application.life_cycle(), LifeCycle::kConstructed);
    return Note("prepare");
  }
  void AddHooks(Application&, ServiceHooks&) override { (void)Note("hooks"); }
  Result<void> Begin(Application& application, Diagnostics&) override {
    EXPECT_EQ(application.element().life_cycle(), LifeCycle::kReady);
    return Note("begin");
  }
  void OnStart() override { calls.push_back("start"); }
  void OnEnd(const std::string& verdict) override { calls.push_back("end: " + verdict); }
  void End() noexcept override { calls.push_back("end"); }
  void Release() noexcept override { calls.push_back("release"); }

 private:
  Result<void> Note(const std::string& call) {
    calls.push_back(call);
    if (call != fails_at) return {};
    if (throws_number) throw 1;
    return Error{.message = "no " + call};
  }
};

TEST(ApplicationLoading, AsksExtensionsAtEachOfItsSteps) {
  const auto notes = std::make_shared<Notes>();
  {
    const auto application = LoadCounting(kCounting, {.extensions = {notes}});
    ASSERT_TRUE(application);
    ASSERT_TRUE(application->RunCycles(1));
    ASSERT_TRUE(application->RunCycles(1));
    application->NoteEnd("fine");
  }
  EXPECT_THAT(notes->calls, ElementsAre("prepare", "hooks", "begin", "start", "end: fine", "end", "release"));
}

TEST(ApplicationLoading, FailsWithAnExtensionAndGivesBackWhatItHas) {
  for (const std::string call : {"prepare", "begin"}) {
    const auto notes = std::make_shared<Notes>();
    notes->fails_at = call;
    const auto application = LoadCounting(kCounting, {.extensions = {notes}});
    ASSERT_FALSE(application);
    EXPECT_THAT(application.error().message, "no " + call);
    EXPECT_EQ(notes->calls.back(), "release");
  }
}

TEST(ApplicationLoading, SurvivesAnExceptionOfAnExtensionAtEachStep) {
  for (const std::string call : {"prepare", "hooks", "begin"}) {
    const auto notes = std::make_shared<Notes>();
    notes->fails_at = call;
    notes->throws_number = true;
    const auto application = LoadCounting(kCounting, {.extensions = {notes}});
    ASSERT_FALSE(application) << call;
    EXPECT_THAT(application.error().message, HasSubstr("int")) << call;
    EXPECT_EQ(notes.use_count(), 1) << call << ": the application is gone";
  }
}

TEST(ApplicationLoading, LeavesNothingBehindWhereverMemoryRunsOut) {
  std::size_t tried = 0;
  for (std::size_t nth = 1;; nth += 1 + nth / 20) {
    const auto notes = std::make_shared<Notes>();
    bool has_struck = false;
    {
      FaultInjection injection(InjectedFault::kAllocation, nth);
      std::optional<LoadedApplication> application;
      try {
        application.emplace(LoadCounting(kCounting, {.extensions = {notes}}));
      } catch (const std::bad_alloc&) {  // before loading has begun, or while it was being told
      }
      injection.End();
      has_struck = injection.has_struck();
      if (!has_struck) {
        ASSERT_TRUE(application && *application);
      }
    }
    ASSERT_EQ(notes.use_count(), 1) << "after allocation " << nth;
    ++tried;
    if (!has_struck) break;
  }
  EXPECT_GT(tried, 50u);
}

TEST(ApplicationLoading, ComposesInCodeWhatFilesCompose) {
  const auto application = Application::Compose("composed", {.clock = SchedulerOptions::ClockKind::kSimulated});
  ASSERT_TRUE(application);
  AddCountingTypes(application->plugins());
  auto& source = application->Create<CountingSource>("source");
  ASSERT_TRUE(application->CreateModule("counting/filter", "filter"));
  ASSERT_TRUE(application->Connect("/source/count", "/filter/in"));
  ASSERT_TRUE(application->Set("/source/label", "made in code"));
  ASSERT_TRUE(application->AddThread("main", {.period = std::chrono::milliseconds(10)}));
  EXPECT_EQ(source.life_cycle(), LifeCycle::kConstructed);
  ASSERT_TRUE(application->RunCycles(3));
  EXPECT_EQ(source.label.Get(), "made in code");
  EXPECT_EQ(application->Read<double>("/filter/out").value(), 1003.0);
}

TEST(ApplicationLoading, SaysWhatCannotBeComposed) {
  const auto application = Application::Compose("composed");
  ASSERT_TRUE(application);
  AddCountingTypes(application->plugins());
  const auto missing = application->CreateModule("counting/flter", "filter");
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().ToString(), HasSubstr("counting/flter"));
  ASSERT_TRUE(application->CreateModule("counting/filter", "filter"));
  EXPECT_FALSE(application->CreateModule("counting/filter", "filter")) << "the name is taken";
  EXPECT_THAT(application->Connect("/filter/out", "/filter/inn").error().ToString(), HasSubstr("did you mean 'in'?"));
  EXPECT_FALSE(Application::Compose("a/b"));
}

}  // namespace
}  // namespace runnel::test

// What becomes of a run while memory, or a thread, is short: it begins or does not, and all that happens is told.

#include <new>
#include <optional>

#include <gtest/gtest.h>

#include "plugins/application/run_report.h"
#include "plugins/testing/fault_injection.h"
#include "tests/plugins/application/counting_modules.h"

namespace runnel::test {
namespace {

using namespace std::chrono_literals;

// It does not drive on after a start that has failed.
TEST(RunningFaults, AnApplicationStartsOrStands) {
  std::optional<LoadedApplication> application;
  bool has_failed = false;
  const auto start = [&] {
    try {
      has_failed = !(*application)->Start();
    } catch (const std::bad_alloc&) {
      has_failed = true;
    }
  };
  for (std::size_t nth = 1;; ++nth) {
    SCOPED_TRACE(nth);
    application.emplace(LoadCounting(CountingInRealTime()));
    ASSERT_TRUE(*application);
    FaultInjection injection(InjectedFault::kAllocation, nth);
    start();
    injection.End();
    EXPECT_EQ((*application)->is_running(), !has_failed);
    if (has_failed) {
      ASSERT_TRUE((*application)->Start()) << "there is memory now";
    }
    (*application)->Stop();
    if (!injection.has_struck()) break;
  }
}

TEST(RunningFaults, NoThreadRunsOnWhenWhoLooksThrows) {
  const auto application = LoadCounting(CountingInRealTime());
  EXPECT_THROW((void)application->Run({.is_over = [](Duration) -> bool { throw 7; }}), int);
  EXPECT_FALSE(application->scheduler().is_running());
}

TEST(RunningFaults, AllFaultsAreToldAndHeardOf) {
  constexpr const char* kText = R"(<application name="counting">
  <clock type="simulated" speed="0"/> <thread name="main" period="10ms"/>
  <module name="source" type="counting/source"/>
  <module name="a" type="counting/judge"><parameter name="limit" value="3"/></module>
  <module name="b" type="counting/judge"><parameter name="limit" value="3"/></module>
  <connect from="source/count" to="a/in"/> <connect from="source/count" to="b/in"/>
</application>)";
  for (std::size_t nth = 1;; ++nth) {
    SCOPED_TRACE(nth);
    const auto application = LoadCounting(kText);
    ASSERT_TRUE(application);
    int looks = 0;
    std::optional<FaultInjection> injection;
    const auto ran = application->Run({.limit = 1s, .is_over = [&](Duration) {
                                         if (++looks == 3) injection.emplace(InjectedFault::kAllocation, nth);
                                         return false;
                                       }});
    injection->End();
    ASSERT_TRUE(ran);
    EXPECT_LE(looks, 6) << "both have failed, so it is over";
    const auto events = application->TakeEvents();
    EXPECT_EQ(std::ranges::count(events, ApplicationEvent::Kind::kFault, &ApplicationEvent::kind), 2);
    EXPECT_FALSE(application->report().IsGood());
    if (!injection->has_struck() || HasFatalFailure()) break;
  }
}

}  // namespace
}  // namespace runnel::test

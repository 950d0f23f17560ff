// Silence is reacted to wherever memory was short for a moment.

#include "plugins/testing/fault_injection.h"
#include "tests/plugins/supervision/supervised_robot.h"

namespace runnel::supervised {
namespace {

using test::FaultInjection;
using test::InjectedFault;

TEST(SilenceFaults, TheSafeValueComesAllTheSame) {
  for (std::size_t nth = 1;; ++nth) {
    SCOPED_TRACE(nth);
    Robot robot{SchedulerOptions::ClockKind::kSimulated};
    MustSucceed(
        robot.supervisor.Add({.of = robot.reader.in.path(),
                              .after = 30ms,
                              .fresh_after = 50ms,
                              .reaction = {.published = {{robot.reader.in.path(), "5"}}, .description = "rests"}}));
    robot.scheduler.RunUntil(At(60));
    robot.laser_works = false;
    robot.scheduler.RunUntil(At(80));
    FaultInjection injection(InjectedFault::kAllocation, nth, 2);
    try {
      robot.scheduler.RunUntil(At(100));
    } catch (const std::bad_alloc&) {
    }
    injection.End();
    robot.scheduler.RunUntil(At(300));
    EXPECT_EQ(robot.seen, 5);
    if (!injection.has_struck() || ::testing::Test::HasFailure()) break;
  }
}

}  // namespace
}  // namespace runnel::supervised

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

// Silent, well again, silent: what has begun is done, whatever comes meanwhile.
TEST(SilenceFaults, ASensorMayChangeItsMindBeforeItIsReactedTo) {
  for (const bool is_well_again : {false, true}) {
    for (std::size_t nth = 1;; ++nth) {
      SCOPED_TRACE(std::to_string(nth) + (is_well_again ? ", well again" : ", silent"));
      Robot robot{SchedulerOptions::ClockKind::kSimulated};
      const std::string port = robot.reader.in.path();
      MustSucceed(robot.supervisor.Add({.of = port,
                                        .after = 30ms,
                                        .fresh_after = 50ms,
                                        .reaction = {.published = {{port, "5"}}, .description = "rests"},
                                        .otherwise = {.released = {port}, .description = "goes on"}}));
      robot.scheduler.RunUntil(At(60));
      robot.laser_works = false;
      robot.scheduler.RunUntil(At(80));
      if (is_well_again) {
        robot.scheduler.RunUntil(At(150));
        robot.laser_works = true;
        robot.scheduler.RunUntil(At(190));
      }
      FaultInjection injection(InjectedFault::kAllocation, nth);
      try {
        robot.scheduler.RunUntil(At(is_well_again ? 230 : 100));
      } catch (const std::bad_alloc&) {
      }
      injection.End();
      robot.laser_works = !is_well_again;
      robot.scheduler.RunUntil(At(900));
      EXPECT_EQ(robot.seen, is_well_again ? 5 : 1);
      if (!injection.has_struck() || ::testing::Test::HasFailure()) break;
    }
  }
}

// Of what is taken back nothing is forgotten.
TEST(SilenceFaults, TheSensorThatIsWellAgainIsReadAgain) {
  for (std::size_t nth = 1;; ++nth) {
    SCOPED_TRACE(nth);
    Robot robot{SchedulerOptions::ClockKind::kSimulated};
    const std::string port = robot.reader.in.path();
    MustSucceed(robot.supervisor.Add({.of = port,
                                      .after = 30ms,
                                      .fresh_after = 50ms,
                                      .reaction = {.published = {{port, "5"}}, .description = "rests"},
                                      .otherwise = {.released = {port}, .description = "goes on"}}));
    robot.scheduler.RunUntil(At(60));
    robot.laser_works = false;
    robot.scheduler.RunUntil(At(150));
    EXPECT_EQ(robot.seen, 5);
    robot.laser_works = true;
    robot.scheduler.RunUntil(At(190));
    FaultInjection injection(InjectedFault::kAllocation, nth);
    try {
      robot.scheduler.RunUntil(At(230));
    } catch (const std::bad_alloc&) {
    }
    injection.End();
    robot.scheduler.RunUntil(At(900));
    EXPECT_EQ(robot.seen, 1);
    if (!injection.has_struck() || ::testing::Test::HasFailure()) break;
  }
}

// Two rules, of which neither keeps up the other, neither on the way there nor back.
TEST(PauseFaults, WhatRulesSayAboutAPauseIsDoneAllTheSame) {
  for (const bool goes_on : {false, true}) {
    for (std::size_t nth = 1;; ++nth) {
      SCOPED_TRACE(std::to_string(nth) + (goes_on ? ", goes on" : ", is paused"));
      Robot robot{SchedulerOptions::ClockKind::kSimulated};
      MustSucceed(Port::Connect(robot.laser.out, robot.infrared.in));
      for (const Port* port : {&robot.reader.in, &robot.infrared.in}) {
        SupervisionRule rule{.when = SupervisionRule::When::kPaused,
                             .of = robot.laser.path(),
                             .reaction = {.published = {{port->path(), "5"}}}};
        rule.otherwise.TakeBack(rule.reaction);
        MustSucceed(robot.supervisor.Add(rule));
      }
      robot.scheduler.RunUntil(At(60));
      if (goes_on) MustSucceed(robot.supervisor.SetPaused("/laser", true));
      FaultInjection injection(InjectedFault::kAllocation, nth);
      try {
        (void)robot.supervisor.SetPaused("/laser", !goes_on);
      } catch (const std::bad_alloc&) {
      }
      injection.End();
      robot.scheduler.RunUntil(At(300));
      const bool is_paused = robot.scheduler.IsPaused(robot.laser);
      if (!injection.has_struck()) {
        EXPECT_EQ(is_paused, !goes_on);
      }
      for (const Port* port : {&robot.reader.in, &robot.infrared.in})
        EXPECT_EQ(port->is_set_by_hand(Port::Setter::kRule), is_paused) << port->path();
      EXPECT_EQ(robot.seen, is_paused ? 5 : 1);
      if (!injection.has_struck() || ::testing::Test::HasFailure()) break;
    }
  }
}

}  // namespace
}  // namespace runnel::supervised

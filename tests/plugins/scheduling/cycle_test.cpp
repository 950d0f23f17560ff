#include <thread>

#include <gmock/gmock.h>

#include "plugins/scheduling/real_thread.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/scheduling/thread_options.h"
#include "plugins/timing/cycle_statistics.h"
#include "plugins/timing/pacing.h"
#include "tests/plugins/scheduling/test_modules.h"

namespace runnel {
namespace {

using OnOverrun = ThreadOptions::OnOverrun;

TEST(DueTime, GoesFromPeriodToPeriodWithoutDrift) {
  DueTime due(At(3), 10ms, OnOverrun::kSkip);
  EXPECT_EQ(due.next(), At(3));
  EXPECT_FALSE(due.Advance(At(9)));
  EXPECT_EQ(due.next(), At(13));
  EXPECT_FALSE(due.Advance(At(23)));  // just in time
  EXPECT_EQ(due.next(), At(23));
}

TEST(DueTime, LeavesOutWhatAnOverrunHasUsedUp) {
  DueTime due(At(0), 10ms, OnOverrun::kSkip);
  EXPECT_TRUE(due.Advance(At(11)));
  EXPECT_EQ(due.next(), At(20));
  EXPECT_TRUE(due.Advance(At(60)));
  EXPECT_EQ(due.next(), At(60));
}

TEST(DueTime, CatchesUpIfToldTo) {
  DueTime due(At(0), 10ms, OnOverrun::kCatchUp);
  EXPECT_TRUE(due.Advance(At(25)));
  EXPECT_EQ(due.next(), At(10));
  EXPECT_TRUE(due.Advance(At(26)));
  EXPECT_FALSE(due.Advance(At(27)));
  EXPECT_EQ(due.next(), At(30));
}

TEST(DueTime, OfAPeriodOfCenturiesComesOnce) {
  for (const auto on_overrun : {OnOverrun::kSkip, OnOverrun::kCatchUp}) {
    DueTime due(At(5), Duration::max(), on_overrun);
    EXPECT_FALSE(due.Advance(At(6)));
    EXPECT_EQ(due.next(), Time::max());
    EXPECT_FALSE(due.Advance(At(7)));
    EXPECT_EQ(due.next(), Time::max());
  }
  DueTime almost(At(5), Duration::max() - 20ms, OnOverrun::kSkip);
  EXPECT_TRUE(almost.Advance(Time::max() - 1ms));
  EXPECT_EQ(almost.next(), Time::max());
}

// A laptop that was closed for an hour, or a process that stood still.
TEST(DueTime, AfterAJumpOfTheClockGoesOnWithThePlan) {
  DueTime due(At(0), 10ms, OnOverrun::kSkip);
  EXPECT_TRUE(due.Advance(At(3'600'005)));
  EXPECT_EQ(due.next(), At(3'600'010));
  EXPECT_FALSE(due.Advance(At(3'600'012)));
  EXPECT_EQ(due.next(), At(3'600'020));
}

// The times at which cycles begin if the first of them takes 25 ms.
std::vector<std::int64_t> StartsAfterALongCycle(OnOverrun on_overrun, CycleStatistics& statistics) {
  Runtime runtime;
  Scheduler scheduler(runtime, {.clock = SchedulerOptions::ClockKind::kSimulated});
  auto& thread = CreateThread(runtime, "main", {.period = 10ms, .on_overrun = on_overrun});
  auto& module = runtime.Create<Doing>(runtime.root(), "module");
  std::vector<std::int64_t> starts;
  module.action = [&](Doing& each) {
    starts.push_back(each.cycle_time().time_since_epoch() / 1ms);
    if (starts.size() == 1) scheduler.simulated_clock().Advance(25ms);
  };
  MustSucceed(runtime.MakeReady(runtime.root()));
  scheduler.RunUntil(At(50));
  statistics = thread.statistics();
  return starts;
}

TEST(Overruns, SkipCyclesByDefault) {
  CycleStatistics statistics;
  EXPECT_THAT(StartsAfterALongCycle(OnOverrun::kSkip, statistics), ElementsAre(0, 30, 40));
  EXPECT_EQ(statistics.overruns, 1u);
  EXPECT_EQ(statistics.jitter_max, 0ms);
}

TEST(Overruns, AreCaughtUpIfToldTo) {
  CycleStatistics statistics;
  EXPECT_THAT(StartsAfterALongCycle(OnOverrun::kCatchUp, statistics), ElementsAre(0, 25, 25, 30, 40));
  EXPECT_EQ(statistics.overruns, 2u);  // the long cycle, and the one that came 15 ms late after it
  EXPECT_EQ(statistics.jitter_max, 15ms);
}

TEST(CycleMeter, CountsAndAverages) {
  CycleMeter meter;
  EXPECT_EQ(meter.statistics().cycles, 0u);
  meter.Add({.due = At(0), .start = At(1), .execution = 2ms, .overrun = false});
  EXPECT_EQ(meter.statistics().period_mean, 0ms);
  meter.Add({.due = At(10), .start = At(10), .execution = 4ms, .overrun = true});
  meter.Add({.due = At(20), .start = At(25), .execution = 3ms, .overrun = false});
  const CycleStatistics statistics = meter.statistics();
  EXPECT_EQ(statistics.cycles, 3u);
  EXPECT_EQ(statistics.overruns, 1u);
  EXPECT_EQ(statistics.period_mean, 12ms);
  EXPECT_EQ(statistics.period_min, 9ms);
  EXPECT_EQ(statistics.period_max, 15ms);
  EXPECT_EQ(statistics.jitter_mean, 2ms);
  EXPECT_EQ(statistics.jitter_max, 5ms);
  EXPECT_EQ(statistics.execution_mean, 3ms);
  EXPECT_EQ(statistics.execution_max, 4ms);
}

TEST(CycleMeter, IsReadWholeWhileItIsWritten) {
  CycleMeter meter;
  std::thread writer([&] {
    // Each cycle is as long as its number: mean and maximum follow from the count.
    for (std::int64_t i = 1; i <= 20000; ++i) {
      meter.Add({.due = At(i), .start = At(i), .execution = Duration(2 * i), .overrun = true});
    }
  });
  CycleStatistics statistics;
  while (statistics.cycles < 20000) {
    statistics = meter.statistics();
    const auto cycles = static_cast<std::int64_t>(statistics.cycles);
    ASSERT_EQ(statistics.overruns, statistics.cycles);
    ASSERT_EQ(statistics.execution_max.count(), 2 * cycles);
    ASSERT_EQ(statistics.execution_mean.count(), cycles == 0 ? 0 : cycles + 1);
  }
  writer.join();
}

TEST(Pacing, StretchesTimeByTheSpeed) {
  ManualClock real;
  real.Set(At(1000));
  Pacing pacing(2, real);
  EXPECT_EQ(pacing.Deadline(At(50)), At(1000));
  EXPECT_EQ(pacing.Deadline(At(150)), At(1050));
  real.Set(At(1040));
  EXPECT_EQ(pacing.Deadline(At(250)), At(1100));
}

TEST(Pacing, DoesNotRaceAfterAPause) {
  ManualClock real;
  Pacing pacing(1, real);
  EXPECT_EQ(pacing.Deadline(At(0)), At(0));
  real.Set(At(5000));
  EXPECT_EQ(pacing.Deadline(At(10)), At(5000));
  EXPECT_EQ(pacing.Deadline(At(20)), At(5010));
}

TEST(Pacing, WaitsForNothingAtSpeedZero) {
  ManualClock real;
  real.Set(At(7));
  Pacing pacing(0, real);
  EXPECT_EQ(pacing.Deadline(At(1'000'000)), At(7));
}

TEST(Pacing, GoesOnFromWhereItIsAtAnotherSpeed) {
  ManualClock real;
  Pacing pacing(1, real);
  EXPECT_EQ(pacing.Deadline(At(0)), At(0));
  EXPECT_EQ(pacing.Deadline(At(1000)), At(1000));
  real.Set(At(400));
  pacing.SetSpeed(2);
  EXPECT_EQ(pacing.Deadline(At(1000)), At(700));
  pacing.SetSpeed(1e-6);
  EXPECT_EQ(pacing.Deadline(At(401)), At(1'000'400));
  pacing.SetSpeed(0);
  EXPECT_EQ(pacing.Deadline(At(1000)), At(400));
}

TEST(Pacing, GainsNothingByBeingToldASpeedAgainAndAgain) {
  ManualClock real;
  Pacing pacing(1, real);
  EXPECT_EQ(pacing.Deadline(At(0)), At(0));
  EXPECT_EQ(pacing.Deadline(At(10)), At(10));
  for (int i = 1; i <= 100; ++i) {
    real.Set(At(i));
    pacing.SetSpeed(1);
  }
  // It stood at what was asked for, 90 ms ago, and not beyond.
  EXPECT_EQ(pacing.Deadline(At(20)), At(110));
}

TEST(Pacing, TakesOnlySpeedsWhoseDeadlinesATimeCanHold) {
  EXPECT_TRUE(Pacing::Takes(0));
  EXPECT_TRUE(Pacing::Takes(1e-6));
  EXPECT_TRUE(Pacing::Takes(1e6));
  EXPECT_FALSE(Pacing::Takes(1e-300));
  EXPECT_FALSE(Pacing::Takes(-1));
  EXPECT_FALSE(Pacing::Takes(1e7));
  ManualClock real;
  Pacing pacing(1e-6, real);
  EXPECT_EQ(pacing.Deadline(At(0)), At(0));
  EXPECT_GT(pacing.Deadline(At(std::int64_t{1} << 40)), At(0));  // some 1e15 s from now
}

TEST(RealtimeSetup, WarnsButNeverFails) {
  std::thread thread([] {
    PrefaultStack();
    if (const auto warning = UseScheduling(pthread_self(), 10)) {
      EXPECT_THAT(warning->message, ::testing::HasSubstr("SCHED_FIFO with priority 10"));
    } else {
      int policy = 0;
      sched_param parameters{};
      pthread_getschedparam(pthread_self(), &policy, &parameters);
      EXPECT_EQ(policy, SCHED_FIFO);
    }
  });
  thread.join();
}

TEST(ThreadContainer, RefusesOptionsThatMakeNoSense) {
  Runtime runtime;
  EXPECT_THROW(CreateThread(runtime, "a", {.period = 0ms}), ElementError);
  EXPECT_THROW(CreateThread(runtime, "b", {.priority = 100}), ElementError);
  EXPECT_EQ(CreateThread(runtime, "a").path(), "/threads/a");
  EXPECT_THROW(CreateThread(runtime, "a"), ElementError);
}

}  // namespace
}  // namespace runnel

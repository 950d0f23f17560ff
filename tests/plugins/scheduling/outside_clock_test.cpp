// Simulated time that follows another clock.

#include <gmock/gmock.h>

#include "core/module/group.h"
#include "plugins/scheduling/scheduler.h"
#include "tests/plugins/scheduling/test_modules.h"

namespace runnel {
namespace {

struct Follower {
  explicit Follower(const std::string& port = "")
      : scheduler(runtime, {.clock = SchedulerOptions::ClockKind::kSimulated,
                            .follows_outside_clock = true,
                            .clock_port = port,
                            .default_options = {.period = 10ms}}) {
    module.action = [this](Doing& each) { times.push_back(each.cycle_time()); };
    MustSucceed(runtime.MakeReady(runtime.root()));
  }
  // What may run now.
  void Run() {
    while (scheduler.Advance({}, Duration{}) == Scheduler::StepResult::kCycle) {
    }
  }

  Runtime runtime;
  Doing& module = runtime.Create<Doing>(runtime.root(), "module");
  std::vector<Time> times;
  Scheduler scheduler;
};

TEST(OutsideClock, CyclesRunUntilWhatItShows) {
  Follower follower;
  follower.Run();
  EXPECT_TRUE(follower.times.empty()) << "it has shown nothing yet";
  MustSucceed(follower.scheduler.pace().SetTime(At(1'700'000'000'000)));
  follower.Run();
  EXPECT_EQ(follower.times, std::vector{At(1'700'000'000'000)}) << "where time begins";
  MustSucceed(follower.scheduler.pace().SetTime(At(1'700'000'000'025)));
  follower.Run();
  ASSERT_EQ(follower.times.size(), 3u);
  EXPECT_EQ(follower.times.back(), At(1'700'000'000'020));
  EXPECT_EQ(follower.runtime.clock().Now(), At(1'700'000'000'025));
}

TEST(OutsideClock, IsOneClockOfThoseThatCanBeFollowed) {
  Follower follower;
  EXPECT_FALSE(follower.scheduler.pace().SetSpeed(2));
  Runtime runtime;
  Scheduler other(runtime, {.clock = SchedulerOptions::ClockKind::kSimulated});
  EXPECT_THAT(other.pace().SetTime(At(1)).error().hint, HasSubstr("outside"));
}

// A simulator begins anew, or a recording is played again: neither waits until the time of before has come again, nor computes
// what would have been in between.
TEST(OutsideClock, WhereItJumpsWhatRunsGoesOnFromThere) {
  for (const Time to : {At(50'000), At(1'700'000'000'000)}) {
    Follower follower;
    Pace& pace = follower.scheduler.pace();
    MustSucceed(pace.SetTime(At(100'000)));
    follower.Run();
    MustSucceed(pace.SetTime(to));
    follower.Run();
    EXPECT_EQ(follower.times, std::vector{At(100'000)});
    MustSucceed(pace.SetTime(to + 25ms));
    follower.Run();
    EXPECT_EQ(follower.times, (std::vector{At(100'000), At(100'010), At(100'020)}));
    EXPECT_EQ(follower.runtime.clock().Now() - pace.outside_lead(), to + 25ms)
        << "by which stamps are that others read";
    const auto faults = follower.scheduler.TakeFaults();
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_EQ(faults[0].path, "/clock");
    EXPECT_THAT(faults[0].message, HasSubstr("the clock that is followed jumps from 100.000000 s to "));
  }
}

// As where two say what time it is.
TEST(OutsideClock, OneJumpAfterTheOtherIsToldOnce) {
  Follower follower;
  for (const int time : {100'000, 5'000, 100'010, 5'010, 100'020}) {
    MustSucceed(follower.scheduler.pace().SetTime(At(time)));
    follower.Run();
  }
  EXPECT_EQ(follower.scheduler.TakeFaults().size(), 1u);
}

TEST(OutsideClock, APortSaysIt) {
  Follower follower("/bridge/clock");
  Output<double> clock{follower.runtime.Create<Group>(follower.runtime.root(), "bridge"), "clock"};
  clock.Publish(5.0);
  follower.Run();
  EXPECT_EQ(follower.times, std::vector{At(5000)});
  clock.Publish(5.015);
  follower.Run();
  EXPECT_EQ(follower.times.back(), At(5010));
  clock.Publish(1.0);
  follower.Run();
  follower.Run();
  const auto faults = follower.scheduler.TakeFaults();
  ASSERT_EQ(faults.size(), 1u) << "told once";
  EXPECT_THAT(faults[0].message, HasSubstr("jumps from 5.015000 s to 1.000000 s"));
  clock.Publish(1.005);
  follower.Run();
  EXPECT_EQ(follower.times.back(), At(5020));
}

}  // namespace
}  // namespace runnel

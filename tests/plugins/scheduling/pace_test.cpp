#include "plugins/scheduling/pace.h"

#include <atomic>
#include <thread>

#include <gmock/gmock.h>

#include "plugins/scheduling/scheduler.h"
#include "tests/plugins/scheduling/test_modules.h"

namespace runnel {
namespace {

using StepResult = Scheduler::StepResult;

constexpr auto kSimulated = SchedulerOptions::ClockKind::kSimulated;

class Paced : public ::testing::Test {
 protected:
  Paced() { CreateThread(runtime, "main", {.period = 10ms}); }

  Doing& Make(const std::string& name) {
    auto& module = runtime.Create<Doing>(runtime.root(), name);
    module.action = [this](Doing&) { ++runs; };
    MustSucceed(runtime.MakeReady(runtime.root()));
    return module;
  }

  Runtime runtime;
  Scheduler scheduler{runtime, {.clock = kSimulated}};
  std::atomic<int> runs{0};
};

TEST_F(Paced, RunsNothingWhilePaused) {
  Make("module");
  MustSucceed(scheduler.pace().Pause());
  EXPECT_TRUE(scheduler.pace().is_paused());
  EXPECT_EQ(scheduler.Advance({}, 0ms), StepResult::kTimeout);
  EXPECT_EQ(scheduler.Advance(At(100), 1ms), StepResult::kTimeout);
  EXPECT_EQ(runs, 0);
  EXPECT_EQ(runtime.clock().Now(), At(0));
  MustSucceed(scheduler.pace().Resume());
  EXPECT_EQ(scheduler.Advance(At(100), 0ms), StepResult::kCycle);
  EXPECT_TRUE(scheduler.RunUntil(At(100)));
  EXPECT_EQ(runs, 10);
}

TEST_F(Paced, RunsAsManyCyclesAsItIsToStep) {
  Make("module");
  MustSucceed(scheduler.pace().StepCycles(2));
  EXPECT_TRUE(scheduler.pace().is_paused());
  MustSucceed(scheduler.pace().StepCycles());
  EXPECT_EQ(scheduler.pace().cycles_to_step(), 3U);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(scheduler.Advance({}, 0ms), StepResult::kCycle);
  EXPECT_EQ(scheduler.pace().cycles_to_step(), 0U);
  EXPECT_EQ(scheduler.Advance({}, 0ms), StepResult::kTimeout);
  EXPECT_EQ(runs, 3);
}

TEST_F(Paced, ForgetsWhatItWasToStepWhenItIsPausedOrResumed) {
  Make("module");
  MustSucceed(scheduler.pace().StepCycles(5));
  MustSucceed(scheduler.pace().Pause());
  EXPECT_EQ(scheduler.Advance({}, 0ms), StepResult::kTimeout);
  MustSucceed(scheduler.pace().StepCycles(5));
  MustSucceed(scheduler.pace().Resume());
  EXPECT_EQ(scheduler.pace().cycles_to_step(), 0U);
  EXPECT_EQ(scheduler.Advance({}, 0ms), StepResult::kCycle);
}

TEST_F(Paced, RefusesWhatWouldWaitForCyclesOfARunThatHasEnded) {
  Make("module");
  MustSucceed(scheduler.pace().StepCycles(3));
  scheduler.pace().End();
  EXPECT_EQ(scheduler.pace().cycles_to_step(), 0u);
  for (const auto& refused : {scheduler.pace().StepCycles(), scheduler.pace().Pause(), scheduler.pace().Resume(),
                              scheduler.pace().SetSpeed(2)}) {
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("the run has ended"));
  }
  scheduler.pace().Begin();
  MustSucceed(scheduler.pace().StepCycles());
  EXPECT_EQ(scheduler.Advance(At(100), 0ms), StepResult::kCycle);
}

TEST_F(Paced, MayBeginWithAPause) {
  Runtime other;
  Scheduler waiting(other, {.clock = kSimulated, .is_paused = true});
  EXPECT_TRUE(waiting.pace().is_paused());
  CreateThread(other, "main");
  other.Create<Doing>(other.root(), "module");
  MustSucceed(other.MakeReady(other.root()));
  EXPECT_EQ(waiting.Advance({}, 0ms), StepResult::kTimeout);
}

TEST_F(Paced, EndsWhatWaitsForItWhenAStopIsRequested) {
  Make("module");
  MustSucceed(scheduler.pace().Pause());
  std::thread stopping([this] { scheduler.RequestStop(); });
  EXPECT_FALSE(scheduler.RunUntil(At(100)));
  EXPECT_FALSE(scheduler.Step());
  stopping.join();
  EXPECT_EQ(scheduler.Advance({}, 1h), StepResult::kStopped);
  EXPECT_EQ(runs, 0);
}

TEST_F(Paced, WakesWhatWaitsForItWhenItIsResumedOrMadeFaster) {
  Make("module");
  MustSucceed(scheduler.pace().Pause());
  std::thread resuming([this] { MustSucceed(scheduler.pace().Resume()); });
  EXPECT_TRUE(scheduler.RunUntil(At(100)));
  resuming.join();
  MustSucceed(scheduler.pace().SetSpeed(Pacing::kSlowest));
  EXPECT_EQ(scheduler.Advance({}, 0ms), StepResult::kCycle);    // which the clocks are tied at
  EXPECT_EQ(scheduler.Advance({}, 1ms), StepResult::kTimeout);  // the next is hours away
  std::thread faster([this] { MustSucceed(scheduler.pace().SetSpeed(0)); });
  EXPECT_TRUE(scheduler.RunUntil(At(200)));
  faster.join();
  EXPECT_EQ(runs, 20);
}

TEST_F(Paced, LetsModulesPauseTheirOwnTime) {
  auto& module = Make("module");
  module.action = [this](Doing&) {
    if (++runs == 3) MustSucceed(scheduler.pace().Pause());
  };
  while (scheduler.Advance({}, 0ms) == StepResult::kCycle) {
  }
  EXPECT_EQ(runs, 3);
}

TEST_F(Paced, LetsTheStructureBeChangedInAPause) {
  Make("first");
  MustSucceed(scheduler.pace().Pause());
  std::thread running([this] { EXPECT_TRUE(scheduler.RunUntil(At(30))); });
  {
    auto hold = scheduler.HoldCycles({"/first"}, 10s);
    ASSERT_TRUE(hold);
  }
  AssignThread(Make("second"), CreateThread(runtime, "other", {.period = 5ms}));
  MustSucceed(scheduler.pace().Resume());
  running.join();
  EXPECT_EQ(runs, 3 + 6);
}

TEST_F(Paced, ComputesTheSameWhateverIsPausedSteppedOrSpedUp) {
  // A map that doubles each difference, told the time of its cycle.
  const auto trajectory = [](Scheduler& runs_it, Runtime& in, const auto& meanwhile) {
    auto& module = in.Create<Doing>(in.root(), "module");
    CreateThread(in, "main", {.period = 1ms});
    std::vector<double> values;
    double x = 0.3;
    module.action = [&](Doing& self) {
      x = 3.99 * x * (1 - x) * (1 - 1e-3 * (ToSeconds(self.cycle_time()) - x * 1e-9));
      values.push_back(x);
    };
    MustSucceed(in.MakeReady(in.root()));
    std::atomic<bool> is_over{false};
    std::thread disturbing([&] {
      for (unsigned i = 1; !is_over; ++i) meanwhile(runs_it.pace(), i);
      (void)runs_it.pace().Resume();
      (void)runs_it.pace().SetSpeed(0);
    });
    EXPECT_TRUE(runs_it.RunUntil(At(500)));
    is_over = true;
    disturbing.join();
    return values;
  };
  Runtime undisturbed_runtime;
  Scheduler undisturbed(undisturbed_runtime, {.clock = kSimulated});
  const auto expected =
      trajectory(undisturbed, undisturbed_runtime, [](Pace&, unsigned) { std::this_thread::yield(); });
  ASSERT_EQ(expected.size(), 500U);
  Runtime disturbed_runtime;
  Scheduler disturbed(disturbed_runtime, {.clock = kSimulated, .speed = 1, .is_paused = true});
  std::atomic<int> changes{0};
  const auto found = trajectory(disturbed, disturbed_runtime, [&](Pace& pace, unsigned i) {
    ++changes;
    if (i % 7 == 0) MustSucceed(pace.Pause());
    if (i % 3 == 0) MustSucceed(pace.StepCycles(1 + i % 5));
    if (i % 5 == 0) MustSucceed(pace.SetSpeed(5 + i % 11));
    if (i % 11 == 0) MustSucceed(pace.Resume());
    std::this_thread::sleep_for(500us);
  });
  EXPECT_EQ(found, expected);  // bit for bit
  EXPECT_GT(changes, 3);
}

TEST(PaceOfRealTime, CannotBeChanged) {
  SteadyClock machine;
  Pace pace(false, 0, false, machine);
  EXPECT_FALSE(pace.is_simulated());
  EXPECT_FALSE(pace.is_paused());
  EXPECT_EQ(pace.speed(), 1);
  EXPECT_EQ(pace.Pause().error().message, "real time cannot be paused");
  EXPECT_THAT(pace.Resume().error().hint, HasSubstr("<clock type=\"simulated\"/>"));
  EXPECT_EQ(pace.StepCycles().error().message, "real time cannot be stepped");
  EXPECT_EQ(pace.SetSpeed(2).error().message, "real time cannot be made faster or slower");
  EXPECT_FALSE(pace.is_paused());
}

TEST(PaceOfSimulatedTime, TakesOnlyWhatItCanKeep) {
  SteadyClock machine;
  Pace pace(true, 2, false, machine);
  EXPECT_EQ(pace.speed(), 2);
  EXPECT_THAT(pace.SetSpeed(-1).error().hint, HasSubstr("1e-6 .. 1e6"));
  EXPECT_FALSE(pace.SetSpeed(1e-7));
  EXPECT_FALSE(pace.SetSpeed(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(pace.speed(), 2);
  EXPECT_FALSE(pace.StepCycles(0));
  EXPECT_FALSE(pace.StepCycles(Pace::kMostCycles + 1));
  EXPECT_FALSE(pace.is_paused());
  MustSucceed(pace.StepCycles(Pace::kMostCycles));
  MustSucceed(pace.StepCycles(Pace::kMostCycles));
  EXPECT_EQ(pace.cycles_to_step(), Pace::kMostCycles);
}

}  // namespace
}  // namespace runnel

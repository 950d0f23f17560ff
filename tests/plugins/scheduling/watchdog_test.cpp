// Modules that do not return from their cycles.

#include <latch>

#include "plugins/scheduling/running_task.h"
#include "tests/plugins/scheduling/counted_allocation.h"
#include "tests/plugins/scheduling/real_threads_fixture.h"

namespace runnel {
namespace {

using ::testing::HasSubstr;

/// A module that stays in its cycle until it is let go, and one of another thread that runs on.
class Watchdog : public RealThreads {
 protected:
  Watchdog() {
    auto& stays = runtime.Create<Doing>(runtime.root(), "stays");
    stays.action = [this](Doing&) {
      if (!holds) return;
      is_within = true;
      is_within.notify_all();
      holds.wait(true);
      is_within = false;
    };
    AssignThread(stays, CreateThread(runtime, "stuck", {.period = 1ms}));
    AssignThread(MakeCounter("runs", count), CreateThread(runtime, "other", {.period = 1ms}));
    Ready();
  }
  ~Watchdog() override { LetGo(); }

  void LetGo() {
    holds = false;
    holds.notify_all();
  }
  std::vector<Fault> WaitForFault() {
    std::vector<Fault> faults;
    WaitUntil("there is a fault", [&] { return !(faults = scheduler.TakeFaults()).empty(); });
    return faults;
  }

  std::atomic<bool> holds{true};
  std::atomic<bool> is_within{false};
  std::atomic<int> count{0};
};

TEST_F(Watchdog, NamesTheModuleWhileItIsStuckAndTellsOfItsReturn) {
  std::atomic<int> stuck{0};
  std::atomic<int> returned{0};
  scheduler.AddStuckRule({.of = "/stays",
                          .after = 20ms,
                          .on_stuck = [&](const Fault&) { ++stuck; },
                          .on_return = [&](const Fault&) { ++returned; }});
  scheduler.AddStuckRule({.of = "/runs", .after = 20ms});
  const Running running(scheduler);
  const auto faults = WaitForFault();
  EXPECT_TRUE(is_within);
  ASSERT_THAT(faults, SizeIs(1)) << "once for one run, and nothing of others";
  EXPECT_EQ(faults[0].path, "/stays");
  EXPECT_EQ(faults[0].kind, Fault::Kind::kStuck);
  EXPECT_THAT(faults[0].message, HasSubstr("at most 20ms is allowed"));
  ASSERT_THAT(scheduler.StuckModules(), SizeIs(1));
  EXPECT_EQ(scheduler.StuckModules()[0].thread, "/threads/stuck");
  WaitUntil("the rule has been applied", [&] { return stuck == 1; });
  const int before = count;
  WaitUntil("the other thread runs on", [&] { return count > before + 10; });
  EXPECT_EQ(returned, 0);
  LetGo();
  WaitUntil("it is told that it has returned", [&] { return returned == 1; });
  EXPECT_EQ(WaitForFault().at(0).kind, Fault::Kind::kReturned);
  EXPECT_THAT(scheduler.StuckModules(), IsEmpty());
}

TEST_F(Watchdog, EachRuleHasItsOwnTime) {
  scheduler.AddStuckRule({.of = "/", .after = 10ms});
  scheduler.AddStuckRule({.of = "/stays", .after = 40ms});
  scheduler.AddStuckRule({.of = "/stays", .after = 1h});
  const Running running(scheduler);
  std::vector<Fault> faults = WaitForFault();
  while (faults.size() < 2) std::ranges::move(WaitForFault(), std::back_inserter(faults));
  EXPECT_THAT(faults[0].message, HasSubstr("at most 10ms"));
  EXPECT_THAT(faults[1].message, HasSubstr("at most 40ms"));
  LetGo();
}

TEST_F(Watchdog, ALimitIsSetAndTakenBackWhileItRuns) {
  const Running running(scheduler);
  is_within.wait(false);
  MustSucceed(scheduler.SetStuckLimit("/stays", 5ms));
  EXPECT_THAT(scheduler.StuckRules(), SizeIs(1));
  // What runs has begun before anybody noted what runs: it is seen from its next run on.
  LetGo();
  WaitUntil("it has left its cycle", [&] { return !is_within; });
  holds = true;
  EXPECT_EQ(WaitForFault().at(0).path, "/stays");
  MustSucceed(scheduler.SetStuckLimit("/stays", {}));
  EXPECT_THAT(scheduler.StuckRules(), IsEmpty());
  EXPECT_FALSE(scheduler.SetStuckLimit("/stays", -5ms));
  LetGo();
}

TEST_F(Watchdog, TheDefaultIsForThoseThatNoOtherRuleIsAbout) {
  MustSucceed(scheduler.SetStuckLimit("", 5ms));
  scheduler.AddStuckRule({.of = "/threads/stuck", .after = 50ms});
  const Running running(scheduler);
  EXPECT_THAT(WaitForFault().at(0).message, HasSubstr("at most 50ms"));
  MustSucceed(scheduler.SetStuckLimit("/stays", {}));
  EXPECT_THAT(scheduler.StuckRules(), SizeIs(3)) << "that it may take as long as it likes is a rule, too";
  LetGo();
}

// The thread that steps is the one that is stuck.
TEST(StuckInSimulatedTime, IsToldAndAnsweredByAnotherThread) {
  Runtime runtime;
  Scheduler scheduler(runtime, {.clock = SchedulerOptions::ClockKind::kSimulated});
  auto& module = runtime.Create<Doing>(runtime.root(), "stays");
  std::atomic<int> stuck{0}, listened{0}, returned{0};
  scheduler.AddStuckRule({.of = "/stays",
                          .after = 20ms,
                          .on_stuck =
                              [&](const Fault& fault) {
                                EXPECT_EQ(fault.time, testing::At(10));
                                ++stuck;
                              },
                          .on_return = [&](const Fault&) { ++returned; }});
  scheduler.SetStuckListener([&] { ++listened; });
  module.action = [&](Doing& of) {
    if (of.cycle_time() != testing::At(10)) return;
    test::WaitUntil("the rule has been applied", [&] { return stuck == 1 && listened > 0; });
    EXPECT_EQ(scheduler.StuckModules().at(0).path, "/stays");
  };
  MustSucceed(runtime.MakeReady(runtime.root()));
  scheduler.RunUntil(testing::At(50));
  test::WaitUntil("it is told that it has returned", [&] {
    (void)scheduler.TakeFaults();
    return returned == 1;
  });
  EXPECT_EQ(stuck, 1);
  EXPECT_THAT(scheduler.StuckModules(), IsEmpty());
}

TEST_F(Watchdog, StoppingDoesNotWaitForWhoIsStuckAndStartingDoes) {
  scheduler.AddStuckRule({.of = "/", .after = 10ms});
  MustSucceed(scheduler.Start());
  is_within.wait(false);
  scheduler.Stop();
  EXPECT_TRUE(is_within);
  const int before = count;
  const auto refused = scheduler.Start();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().path, "/stays");
  EXPECT_EQ(count, before) << "others have ended";
  LetGo();
  WaitUntil("it can be started again", [&] { return scheduler.Start().has_value(); });
  WaitUntil("it runs again", [&] { return count > before; });
  scheduler.Stop();
}

TEST_F(Watchdog, ThreadsAreHeldBetweenCyclesButForThoseThatAreStuck) {
  scheduler.AddStuckRule({.of = "/", .after = 10ms});
  const Running running(scheduler);
  (void)WaitForFault();
  EXPECT_TRUE(scheduler.HoldCycles({"/stays", "/runs"}, 30s, {"/runs"}));
  const auto refused = scheduler.HoldCycles({"/stays", "/runs"}, 30s);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().path, "/threads/stuck");
  LetGo();
}

TEST(NotedCycles, AllocateNothingAndKnowWhatRuns) {
  Runtime runtime;
  auto& module = runtime.Create<Doing>(runtime.root(), "module");
  std::string running;
  running.reserve(100);
  module.action = [&](Doing&) { running = RunningModulePath(); };
  MustSucceed(runtime.MakeReady(runtime.root()));
  Scheduler scheduler(runtime, {.clock = SchedulerOptions::ClockKind::kSimulated, .notes_running_tasks = true});
  scheduler.RunUntil(testing::At(50));
  const int before = testing::AllocationsOfThisThread();
  scheduler.RunUntil(testing::At(500));
  EXPECT_EQ(testing::AllocationsOfThisThread(), before);
  EXPECT_EQ(running, "/module");
  EXPECT_EQ(RunningModulePath(), nullptr);
}

}  // namespace
}  // namespace runnel

// Memory and threads that are not there: nothing is half started, and what is gone runs no more.

#include <array>
#include <limits>
#include <memory>
#include <mutex>

#include <pthread.h>

#include "core/lockfree/thread_epoch.h"
#include "plugins/scheduling/fault_dispatcher.h"
#include "plugins/testing/fault_injection.h"
#include "tests/plugins/scheduling/real_threads_fixture.h"
#include "tests/plugins/scheduling/test_modules.h"

namespace runnel {
namespace {

using test::AtEachPoint;
using test::FaultInjection;
using test::InjectedFault;

/// Two modules with a thread each, one of which runs freely.
struct TwoThreads {
  TwoThreads() {
    for (Doing* each : {&gone, &other}) {
      auto& runs = each == &gone ? runs_of_gone : runs_of_other;
      each->action = [&runs](Doing&) { ++runs; };
    }
    AssignThread(other, CreateThread(runtime, "slow", {.period = 1ms}));
    MustSucceed(runtime.MakeReady(runtime.root()));
  }
  ~TwoThreads() { scheduler.Stop(); }

  std::atomic<int> runs_of_gone{0};
  std::atomic<int> runs_of_other{0};
  Runtime runtime;
  Doing& gone = runtime.Create<Doing>(runtime.root(), "gone");
  Doing& other = runtime.Create<Doing>(runtime.root(), "other");
  ThreadContainer& free = CreateThread(runtime, "free", {.activation = ThreadOptions::Activation::kFreeRunning});
  Scheduler scheduler{runtime};
};

/// While it lives, the system gives no thread.
class NoThreads {
 public:
  NoThreads() {
    EXPECT_EQ(pthread_getattr_default_np(&before_), 0);
    pthread_attr_t huge;
    EXPECT_EQ(pthread_getattr_default_np(&huge), 0);
    EXPECT_EQ(pthread_attr_setstacksize(&huge, std::numeric_limits<std::size_t>::max() / 2 + 1), 0);
    EXPECT_EQ(pthread_setattr_default_np(&huge), 0);
  }
  ~NoThreads() { EXPECT_EQ(pthread_setattr_default_np(&before_), 0); }
  NoThreads(const NoThreads&) = delete;
  NoThreads& operator=(const NoThreads&) = delete;

 private:
  pthread_attr_t before_;
};

class SchedulingFaults : public ::testing::Test {
 protected:
  static void ExpectItRuns(TwoThreads& world) {
    const int gone = world.runs_of_gone;
    const int other = world.runs_of_other;
    WaitUntil("both threads run", [&] { return world.runs_of_gone > gone && world.runs_of_other > other; });
  }
};

// No thread is left over that would run on: all that were started have been joined.
TEST_F(SchedulingFaults, AllThreadsAreStartedOrNone) {
  auto world = std::make_unique<TwoThreads>();
  Result<void> started;
  const std::size_t points = AtEachPoint(
      InjectedFault::kAllocation, [&] { started = world->scheduler.Start(); },
      [&](bool has_struck) {
        ASSERT_EQ(world->scheduler.is_running(), started.has_value());
        if (!started) {
          ASSERT_TRUE(has_struck);
          EXPECT_THAT(started.error().message, ::testing::HasSubstr("could not be started"));
          const int runs = world->runs_of_gone + world->runs_of_other;
          ASSERT_TRUE(world->scheduler.TakeFaults().empty());
          ASSERT_EQ(world->runs_of_gone + world->runs_of_other, runs);
          MustSucceed(world->scheduler.Start());
        }
        ExpectItRuns(*world);
        world = std::make_unique<TwoThreads>();
      });
  EXPECT_GT(points, 10u);
}

// Also what was known before.
TEST_F(SchedulingFaults, AllThatIsSimulatedIsSteppedOnceThereIsMemory) {
  for (std::size_t nth = 1;; ++nth) {
    SCOPED_TRACE(nth);
    Runtime runtime;
    Scheduler scheduler(runtime, {.clock = SchedulerOptions::ClockKind::kSimulated});
    std::array<int, 3> runs{};
    const auto add = [&](const std::string& name, int& counted) {
      auto& module = runtime.Create<Doing>(runtime.root(), name);
      module.action = [&counted](Doing&) { ++counted; };
      AssignThread(module, CreateThread(runtime, name + "_thread", {.period = 1ms}));
      MustSucceed(runtime.MakeReady(module));
    };
    add("before", runs[0]);
    EXPECT_TRUE(scheduler.Step());
    add("one", runs[1]);
    add("other", runs[2]);
    FaultInjection injection(InjectedFault::kAllocation, nth);
    try {
      (void)scheduler.Step();
    } catch (const std::bad_alloc&) {
    }
    injection.End();
    runs = {};
    EXPECT_TRUE(scheduler.RunUntil(runtime.clock().Now() + 2ms));
    EXPECT_THAT(runs, ::testing::Each(::testing::Gt(0)));
    if (!injection.has_struck() || HasFailure()) break;
  }
}

TEST_F(SchedulingFaults, StoppingTakesNoMemory) {
  TwoThreads world;
  MustSucceed(world.scheduler.Start());
  ExpectItRuns(world);
  const FaultInjection injection(InjectedFault::kAllocation, 1, 1000);
  world.scheduler.SetStuckListener({});
  world.scheduler.Stop();
  EXPECT_FALSE(injection.has_struck());
}

// The thread that looks has no memory from the time on at which the first one is stuck.
TEST_F(SchedulingFaults, AModuleIsKnownToBeStuckThoughThereIsNoMemoryToTell) {
  std::atomic<bool> is_stuck{false}, is_short{true};
  TwoThreads world;
  for (Doing* each : {&world.gone, &world.other}) {
    each->action = [&is_stuck](Doing&) {
      while (is_stuck) std::this_thread::yield();
    };
  }
  std::atomic<int> called{0};
  world.scheduler.AddStuckRule({.of = "/gone", .after = 5ms});
  world.scheduler.AddStuckRule({.of = "/other", .after = 50ms});
  world.scheduler.AddStuckRule(
      {.of = "/other", .after = 50ms, .on_stuck = [&](const Fault&) { ++called; }, .ends_run = true});
  std::optional<FaultInjection> injection;  // of the thread that looks
  world.scheduler.SetStuckListener([&] {
    if (is_short && !injection) injection.emplace(InjectedFault::kAllocation, 1, 1'000'000);
    if (!is_short) injection.reset();
  });
  MustSucceed(world.scheduler.Start());
  is_stuck = true;
  WaitUntil("the run is to end", [&] { return world.scheduler.stop_requested(); });
  EXPECT_EQ(called, 0);
  world.scheduler.Stop();  // waits for none that is stuck
  is_stuck = is_short = false;
  WaitUntil("they have returned", [&] { return world.scheduler.StuckModules().empty(); });
}

// The thread that looks has no memory to tell that it has returned.
TEST_F(SchedulingFaults, AModuleThatIsStuckOnceMoreIsKnownToBe) {
  std::atomic<bool> is_stuck{true}, is_short{true};
  TwoThreads world;
  world.gone.action = [&](Doing&) {
    while (is_stuck) std::this_thread::yield();
  };
  world.scheduler.AddStuckRule({.of = "/gone", .after = 5ms});
  std::optional<FaultInjection> injection;
  world.scheduler.SetStuckListener([&] {
    if (is_short && !injection) injection.emplace(InjectedFault::kAllocation, 1, 1'000'000);
    if (!is_short) injection.reset();
  });
  MustSucceed(world.scheduler.Start());
  const auto count = [&] { return world.scheduler.StuckModules().size(); };
  WaitUntil("it is stuck", [&] { return count() == 1 && !world.scheduler.TakeFaults().empty(); });
  is_stuck = false;
  WaitUntil("it has returned", [&] { return count() == 0; });
  is_stuck = true;
  WaitUntil("it is stuck once more", [&] { return count() == 1; });
  is_short = false;
  std::vector<Fault> told;
  WaitUntil("all has been told", [&] { return world.scheduler.TakeFaults(told), told.size() == 2; });
  is_stuck = false;
  EXPECT_EQ(told[0].kind, Fault::Kind::kReturned);
  EXPECT_EQ(told[1].kind, Fault::Kind::kStuck);
  for (const Fault& each : told) EXPECT_EQ(each.path, "/gone");
}

TEST_F(SchedulingFaults, AThreadThatTheSystemDoesNotGiveIsAnError) {
  TwoThreads world;
  world.scheduler.RequestStop();
  std::optional<NoThreads> no_threads(std::in_place);
  const auto started = world.scheduler.Start();
  no_threads.reset();
  ASSERT_FALSE(started);
  EXPECT_THAT(started.error().ToString(), ::testing::HasSubstr("could not be started"));
  EXPECT_FALSE(world.scheduler.is_running());
  MustSucceed(world.scheduler.Start());
  EXPECT_TRUE(world.scheduler.stop_requested()) << "a request before the start holds";
  ExpectItRuns(world);
}

// The lock is held as long as the test looks, so that the supervising thread cannot make a schedule without it.
TEST_F(SchedulingFaults, WhatHasLeftTheTreeRunsNoMoreThoughNoScheduleCanBeMade) {
  constexpr std::size_t kFailures = 20;  // more than anybody tries at once
  bool has_struck = true;
  for (std::size_t nth = 1; has_struck; ++nth) {
    SCOPED_TRACE(nth);
    TwoThreads world;
    MustSucceed(world.scheduler.Start());
    ExpectItRuns(world);
    UnlistedElement taken;
    {
      const std::lock_guard lock(world.runtime.structure_mutex());
      FaultInjection injection(InjectedFault::kAllocation, nth, kFailures);
      taken = world.runtime.Unlist(world.gone).value();
      injection.End();
      has_struck = injection.has_struck();
      const auto cycles = [&] { return world.free.runner()->cycles_begun(); };
      const auto wait_for_two = [&, before = cycles()] {
        WaitUntil("two cycles have begun", [&] { return cycles() >= before + 2; });
      };
      wait_for_two();
      const int runs = world.runs_of_gone;
      const auto before = cycles();
      WaitUntil("further cycles have begun", [&] { return cycles() >= before + 100; });
      ASSERT_EQ(world.runs_of_gone, runs);
    }
    WaitUntil("there is a schedule without it", [&] {
      const EpochGuard guard;
      return world.free.runner()->schedule()->entries.empty();
    });
    world.runtime.Destroy(std::move(taken));
  }
}

TEST(FaultOfAModule, IsAnsweredOnceByEachRuleHoweverShortMemoryIs) {
  int first = 0, second = 0;
  const auto needs_memory = [](const Fault& fault, int& calls) {
    const std::string text = fault.path + " has failed, and that is too long to be kept without memory";
    if (!text.empty()) ++calls;
  };
  for (std::size_t nth = 1;; ++nth) {
    SCOPED_TRACE(nth);
    first = second = 0;
    FaultDispatcher faults;
    faults.AddRule({.of = "/robot", .call = [&](const Fault& fault) { needs_memory(fault, first); }});
    faults.AddRule({.of = "/robot", .call = [&](const Fault& fault) { needs_memory(fault, second); }});
    for (const char* const name : {"/robot/a", "/robot/b"}) {
      auto record = std::make_unique<FaultRecord>(name);
      record->Fill("no answer", At(10), 1);
      faults.Raise(std::move(record));
    }
    FaultInjection injection(InjectedFault::kAllocation, nth);
    try {
      faults.Dispatch();
    } catch (const std::bad_alloc&) {
    }
    injection.End();
    faults.Dispatch();
    EXPECT_EQ(first, 2);
    EXPECT_EQ(second, 2);
    EXPECT_THAT(testing::TakeAll(faults), ::testing::SizeIs(2));
    if (!injection.has_struck() || ::testing::Test::HasFailure()) break;
  }
}

TEST(FaultOfAModule, IsAnsweredByItsRulesIfNoThreadCanMendIt) {
  FaultDispatcher faults;
  faults.SetActsBeside(true);
  int mended = 0, applied = 0;
  faults.SetHandler(
      [&](const Fault&) -> FaultDispatcher::Action { return [&] { return ++mended, std::string("put back"); }; });
  faults.AddRule({.of = "/robot", .call = [&](const Fault&) { ++applied; }});
  const NoThreads no_threads;
  faults.Report({.path = "/robot/laser", .message = "no"});
  EXPECT_EQ(applied, 0) << "one may be had in a moment";
  WaitUntil("the rule has been applied", [&] { return faults.Dispatch(); });
  EXPECT_EQ(applied, 1);
  EXPECT_EQ(mended, 0);
}

}  // namespace
}  // namespace runnel

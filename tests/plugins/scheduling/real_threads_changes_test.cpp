// The structure changes while real threads run.

#include <algorithm>
#include <atomic>
#include <future>
#include <thread>

#include "core/module/group.h"
#include "plugins/scheduling/cycle_runner.h"
#include "tests/plugins/scheduling/real_threads_fixture.h"

namespace runnel {
namespace {

using RealThreadsAndChanges = RealThreads;

TEST_F(RealThreadsAndChanges, TakeInModulesAddedWhileTheyRun) {
  std::atomic<int> runs{0};
  CreateThread(runtime, "main", {.period = 1ms});
  const Running running(scheduler);
  auto& module = MakeCounter("module", runs);
  MustSucceed(runtime.MakeReady(module));
  WaitUntil("the module that was added runs", [&] { return runs > 0; });
}

TEST_F(RealThreadsAndChanges, TakeInContainersAddedWhileTheyRunAndLetThemGo) {
  std::atomic<int> runs{0};
  CreateThread(runtime, "main", {.period = 1ms});
  auto& module = MakeCounter("module", runs);
  Ready();
  const Running running(scheduler);
  for (int round = 0; round < 10; ++round) {
    auto& added = CreateThread(runtime, "added", {.period = 1ms});
    AssignThread(module, added);
    const int before = runs;
    WaitUntil("the added thread runs the module", [&] { return runs > before && added.statistics().cycles > 0; });
    MustSucceed(runtime.Delete(added));
    const int after = runs;
    WaitUntil("another thread runs the module", [&] { return runs > after; });
  }
}

// One that usually takes no time takes long just now; a drive must not stand still meanwhile.
TEST_F(RealThreadsAndChanges, WhoWaitsForALongCycleLetsTheOthersGoOn) {
  std::atomic<int> runs{0};
  std::atomic<bool> may_return{true};
  std::atomic<bool> waits{false};
  auto& drive = MakeCounter("drive", runs);
  auto& planner = runtime.Create<Doing>(runtime.root(), "planner");
  planner.action = [&](Doing&) {
    waits = !may_return;
    while (!may_return) std::this_thread::sleep_for(1ms);
  };
  AssignThread(drive, CreateThread(runtime, "driving", {.period = 1ms}));
  AssignThread(planner, CreateThread(runtime, "planning", {.period = 1ms}));
  Ready();
  const Running running(scheduler);
  WaitUntil("both run", [&] { return runs > 100; });
  may_return = false;
  WaitUntil("one is in a long cycle", [&] { return waits.load(); });
  std::atomic<bool> holds{false};
  std::atomic<bool> is_seen{false};
  std::thread changer([&] {
    const auto hold = scheduler.HoldCycles({"/drive", "/planner"}, 60s);
    EXPECT_TRUE(hold) << hold.error().ToString();
    holds = true;
    WaitUntil("it has been looked at", [&] { return is_seen.load(); });
  });
  std::this_thread::sleep_for(200ms);  // at some time in it both gates would be closed
  const int before = runs;
  WaitUntil("the other one goes on", [&] { return runs > before + 100; });
  EXPECT_FALSE(holds);
  may_return = true;
  WaitUntil("both are held", [&] { return holds.load(); });
  const int held = runs;
  std::this_thread::sleep_for(20ms);
  EXPECT_EQ(runs, held);
  is_seen = true;
  changer.join();
}

// Its own cycles take long enough for it to be kept first, and are short against the one that is waited for.
TEST_F(RealThreadsAndChanges, WhoWaitsForALongCycleLetsAlsoAModerateOneGoOn) {
  std::atomic<int> runs{0};
  std::atomic<bool> may_return{true};
  std::atomic<bool> waits{false};
  auto& drive = runtime.Create<Doing>(runtime.root(), "drive");
  drive.action = [&](Doing&) {
    ++runs;
    std::this_thread::sleep_for(60ms);
  };
  auto& planner = runtime.Create<Doing>(runtime.root(), "planner");
  planner.action = [&](Doing&) {
    waits = !may_return;
    while (!may_return) std::this_thread::sleep_for(1ms);
  };
  AssignThread(drive, CreateThread(runtime, "driving", {.period = 1ms}));
  auto& planning = CreateThread(runtime, "planning", {.period = 1ms});
  AssignThread(planner, planning);
  Ready();
  const Running running(scheduler);
  WaitUntil("both run", [&] { return runs > 5 && planning.statistics().cycles > 5; });
  may_return = false;
  WaitUntil("one is in a long cycle", [&] { return waits.load(); });
  auto held = std::async(std::launch::async, [&] {
    return scheduler.HoldCycles({"/drive", "/planner"}, 10min).has_value();
  });
  struct LetReturn {
    ~LetReturn() { may_return = true; }
    std::atomic<bool>& may_return;
  } const at_the_end{may_return};
  WaitUntil("the drive is kept, and the planner waited for", [&] { return planning.runner()->gate().is_closed(); });
  const int before = runs;
  WaitUntil("the drive goes on", [&] { return runs > before + 3; });
  EXPECT_TRUE(waits);
  EXPECT_NE(held.wait_for(0s), std::future_status::ready);
  may_return = true;
  EXPECT_TRUE(held.get());
}

// Everything that can change does, while three threads run; ThreadSanitizer and AddressSanitizer
// find what is wrong with it.
TEST_F(RealThreadsAndChanges, BearEveryChangeOfTheStructure) {
  auto& first = runtime.Create<Relay>(runtime.root(), "first");
  auto& last = runtime.Create<Relay>(runtime.root(), "last");
  auto& periodic = CreateThread(runtime, "periodic", {.period = 200us});
  auto& free = CreateThread(runtime, "free", {.activation = ThreadOptions::Activation::kFreeRunning});
  auto& waiting = CreateThread(runtime, "waiting", {.activation = ThreadOptions::Activation::kTrigger});
  AssignThread(first, periodic);
  AssignThread(last, free);
  Ready();
  const Running running(scheduler);
  ThreadContainer* const threads[] = {&periodic, &free, &waiting};
  for (int round = 0; round < 60; ++round) {
    auto& group = runtime.Create<Group>(runtime.root(), "group");
    auto& relay = runtime.Create<Relay>(group, "relay");
    auto& listener = runtime.Create<Doing>(group, "listener");
    auto runs = std::make_shared<std::atomic<int>>(0);
    listener.action = [runs](Doing& module) {
      (void)module.in.Read();
      ++*runs;
    };
    MustSucceed(Port::Connect(first.out, relay.in));
    AssignThread(listener, waiting);
    MustSucceed(runtime.MakeReady(group));
    MustSucceed(Port::Connect(relay.out, listener.in, {.queue = 4}));
    MustSucceed(Port::Connect(relay.out, last.in));
    WaitUntil("the listener runs", [&] { return *runs > 0; });
    AssignThread(group, *threads[round % 3]);
    AssignThread(listener, *threads[(round + 1) % 3]);
    if (round % 2 == 0) MustSucceed(Port::Disconnect(relay.out, last.in));
    MustSucceed(runtime.Delete(group));
    const int runs_at_deletion = *runs;
    (void)periodic.statistics();
    EXPECT_EQ(*runs, runs_at_deletion);
  }
  scheduler.Stop();
  EXPECT_THAT(scheduler.TakeFaults(), IsEmpty());
}

// An element is never run by two threads at once, not even while it moves between them.
TEST_F(RealThreadsAndChanges, HandOverAModuleFromThreadToThread) {
  auto& module = runtime.Create<Doing>(runtime.root(), "module");
  std::atomic<bool> inside{false};
  std::atomic<bool> overlap{false};
  int unguarded = 0;  // for ThreadSanitizer
  std::atomic<int> runs{0};
  module.action = [&](Doing&) {
    if (inside.exchange(true, std::memory_order_relaxed)) overlap = true;
    ++unguarded;
    ++runs;
    inside.store(false, std::memory_order_relaxed);
  };
  const ThreadOptions free{.activation = ThreadOptions::Activation::kFreeRunning};
  auto& a = CreateThread(runtime, "a", free);
  auto& b = CreateThread(runtime, "b", free);
  Ready();
  const Running running(scheduler);
  for (int round = 0; round < 200; ++round) {
    const int before = runs;
    AssignThread(module, round % 2 == 0 ? b : a);
    WaitUntil("the module runs in its new thread", [&] { return runs > before; });
  }
  scheduler.Stop();
  EXPECT_FALSE(overlap);
  EXPECT_EQ(unguarded, runs);
}

}  // namespace
}  // namespace runnel

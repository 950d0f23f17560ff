#include <algorithm>
#include <atomic>
#include <thread>

#include <pthread.h>
#include <sched.h>

#include "core/module/group.h"
#include "tests/plugins/scheduling/real_threads_fixture.h"

namespace runnel {
namespace {

TEST_F(RealThreads, RunPeriodically) {
  std::atomic<int> runs{0};
  auto& module = MakeCounter("module", runs);
  std::atomic<bool> is_planned{true};
  std::atomic<bool> is_late_enough{true};
  Time last{};
  module.action = [&](Doing& each) {
    if (each.cycle_period() != 1ms) is_planned = false;
    if (each.cycle_time() <= last) is_late_enough = false;
    last = each.cycle_time();
    ++runs;
  };
  auto& thread = CreateThread(runtime, "main", {.period = 1ms});
  Ready();
  const Running running(scheduler);
  EXPECT_TRUE(scheduler.is_running());
  WaitUntil("there have been five cycles", [&] { return runs >= 5; });
  scheduler.Stop();
  EXPECT_FALSE(scheduler.is_running());
  EXPECT_TRUE(is_planned);
  EXPECT_TRUE(is_late_enough);
  EXPECT_EQ(thread.statistics().cycles, static_cast<std::uint64_t>(runs));
}

TEST_F(RealThreads, DoNotStartBeforeAllIsReady) {
  std::atomic<int> runs{0};
  MakeCounter("module", runs);
  CreateThread(runtime, "main", {.period = 1ms});
  const auto refused = scheduler.Start();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().path, "/module");
  EXPECT_NE(refused.error().hint.find("MakeReady"), std::string::npos);
  EXPECT_FALSE(scheduler.is_running());
  Ready();
  MustSucceed(scheduler.Start());
  WaitUntil("it runs", [&] { return runs > 0; });
}

TEST_F(RealThreads, StandStillAfterStopAndGoOnAfterStart) {
  std::atomic<int> runs{0};
  MakeCounter("module", runs);
  CreateThread(runtime, "main", {.period = 1ms});
  Ready();
  const Running running(scheduler);
  WaitUntil("there have been two cycles", [&] { return runs >= 2; });
  scheduler.Stop();
  scheduler.Stop();
  const int stopped_at = runs;
  std::this_thread::sleep_for(5ms);
  EXPECT_EQ(runs, stopped_at);
  const Running again(scheduler);
  WaitUntil("cycles go on after the second start", [&] { return runs > stopped_at; });
}

TEST_F(RealThreads, RunFreely) {
  std::atomic<int> runs{0};
  MakeCounter("module", runs);
  CreateThread(runtime, "free", {.activation = ThreadOptions::Activation::kFreeRunning});
  Ready();
  const Running running(scheduler);
  WaitUntil("there have been a hundred cycles", [&] { return runs >= 100; });
}

TEST_F(RealThreads, RunOnData) {
  std::atomic<int> received{0};
  auto& source = runtime.Create<Doing>(runtime.root(), "source");
  auto& sink = runtime.Create<Doing>(runtime.root(), "sink");
  source.action = [](Doing& module) { module.out.Publish(1); };
  sink.action = [&](Doing& module) { received += module.in.Read().is_new() ? 1 : 0; };
  MustSucceed(Port::Connect(source.out, sink.in));
  AssignThread(source, CreateThread(runtime, "periodic", {.period = 1ms}));
  AssignThread(sink, CreateThread(runtime, "waiting", {.activation = ThreadOptions::Activation::kTrigger}));
  Ready();
  const Running running(scheduler);
  WaitUntil("five values have set the module off", [&] { return received >= 5; });
}

TEST_F(RealThreads, RunOnDataFromOutsideOfCycles) {
  std::atomic<double> received{0};
  auto& source = runtime.Create<Relay>(runtime.root(), "source");
  auto& sink = runtime.Create<Doing>(runtime.root(), "sink");
  sink.action = [&](Doing& module) { received = *module.in.Read(); };
  MustSucceed(Port::Connect(source.out, sink.in));
  CreateThread(runtime, "waiting", {.activation = ThreadOptions::Activation::kTrigger});
  Ready();
  const Running running(scheduler);
  for (const double value : {1.0, 2.0, 3.0}) {
    source.out.Publish(value);
    WaitUntil("the published value is received", [&] { return received == value; });
  }
}

TEST_F(RealThreads, WakeAThreadThatWasAddedDuringTheCycleThatPublishes) {
  std::atomic<bool> is_inside{false};
  std::atomic<bool> is_there{false};
  std::atomic<int> received{0};
  auto& feeder = runtime.Create<Relay>(runtime.root(), "feeder");
  auto& source = runtime.Create<Doing>(runtime.root(), "source");
  source.action = [&](Doing& module) {
    is_inside = true;
    WaitUntil("the new thread is there", [&] { return is_there.load(); });
    module.out.Publish(1);
  };
  MustSucceed(Port::Connect(feeder.out, source.in));
  const ThreadOptions trigger{.activation = ThreadOptions::Activation::kTrigger};
  CreateThread(runtime, "first", trigger);
  Ready();
  const Running running(scheduler);
  feeder.out.Publish(1);  // one cycle, and no other that would make up for it
  WaitUntil("the source is in its cycle", [&] { return is_inside.load(); });
  auto& waiting = CreateThread(runtime, "waiting", trigger);
  auto& sink = MakeCounter("sink", received);
  AssignThread(sink, waiting);
  MustSucceed(runtime.MakeReady(sink));
  MustSucceed(Port::Connect(source.out, sink.in));
  is_there = true;
  WaitUntil("the new thread is woken", [&] { return received > 0; });
}

TEST_F(RealThreads, StopWhileTheyWaitForData) {
  std::atomic<int> runs{0};
  MakeCounter("module", runs);
  CreateThread(runtime, "waiting", {.activation = ThreadOptions::Activation::kTrigger});
  Ready();
  const Running running(scheduler);
  scheduler.Stop();
  EXPECT_EQ(runs, 0);
}

TEST_F(RealThreads, RunOnWhenAModuleThrows) {
  std::atomic<int> runs{0};
  std::atomic<int> calls{0};
  MakeCounter("healthy", runs);
  auto& failing = runtime.Create<Doing>(runtime.root(), "failing");
  failing.action = [](Doing&) { throw std::runtime_error("broken"); };
  CreateThread(runtime, "main", {.period = 1ms});
  scheduler.AddFaultRule({.of = "/failing", .call = [&](const Fault&) { ++calls; }});
  scheduler.AddFaultRule({.of = "/failing"});
  Ready();
  const Running running(scheduler);
  WaitUntil("the fault rule requests a stop", [&] { return scheduler.stop_requested(); });
  const int runs_then = runs;
  WaitUntil("the healthy module goes on", [&] { return runs > runs_then + 3; });  // until somebody calls Stop()
  scheduler.Stop();
  EXPECT_EQ(calls, 1);
  const auto faults = scheduler.TakeFaults();
  ASSERT_THAT(faults, SizeIs(1));
  EXPECT_EQ(faults[0].path, "/failing");
}

TEST_F(RealThreads, HeedAStopThatWasRequestedBeforeTheyStarted) {
  CreateThread(runtime, "main", {.period = 1ms});
  Ready();
  scheduler.RequestStop();
  const Running running(scheduler);
  EXPECT_TRUE(scheduler.stop_requested());
  EXPECT_FALSE(scheduler.ended_by_fault());
  scheduler.Stop();
  EXPECT_TRUE(scheduler.stop_requested());
  const Running again(scheduler);
  EXPECT_FALSE(scheduler.stop_requested());
}

TEST_F(RealThreads, ApplyFaultRulesInOneThreadOnly) {
  std::atomic<bool> is_inside{false};
  std::atomic<bool> may_go_on{false};
  std::atomic<int> calls{0};
  std::atomic<int> calls_by_others{0};
  const auto test_thread = std::this_thread::get_id();
  runtime.Create<Doing>(runtime.root(), "first").action = [](Doing&) { throw 1; };
  runtime.Create<Doing>(runtime.root(), "second").action = [&](Doing&) {
    WaitUntil("the rule attends to the first fault", [&] { return is_inside.load(); });
    throw 2;
  };
  std::atomic<int> runs{0};
  MakeCounter("healthy", runs);  // made after them, so run after them
  CreateThread(runtime, "main", {.period = 1ms});
  scheduler.AddFaultRule({.call = [&](const Fault&) {
    ++calls;
    if (std::this_thread::get_id() == test_thread) {
      ++calls_by_others;
      return;
    }
    is_inside = true;
    WaitUntil("the fault rule may go on", [&] { return may_go_on.load(); });
  }});
  Ready();
  const Running running(scheduler);
  WaitUntil("the first cycle is over",
            [&] { return runs > 0; });  // the second fault is there, the first is being attended
  EXPECT_THAT(scheduler.TakeFaults(), SizeIs(1));
  may_go_on = true;
  WaitUntil("the rule is applied to both faults", [&] { return calls == 2; });
  EXPECT_EQ(calls_by_others, 0);
}

TEST_F(RealThreads, RunOnWhenWhatSupervisesThemThrowsAnything) {
  std::atomic<int> runs{0};
  std::atomic<int> handled{0};
  MakeCounter("healthy", runs);
  runtime.Create<Doing>(runtime.root(), "failing").action = [](Doing&) { throw 1; };
  CreateThread(runtime, "main", {.period = 1ms});
  scheduler.SetWatchdog([](Time) -> Time { throw 2; });
  scheduler.SetFaultHandler([&](const Fault&) -> FaultDispatcher::Action {
    ++handled;
    throw 3;
  });
  Ready();
  const Running running(scheduler);
  WaitUntil("the fault and the watch that failed are handled", [&] { return handled >= 2; });
  const int runs_then = runs;
  WaitUntil("the healthy module goes on", [&] { return runs > runs_then + 3; });
}

TEST_F(RealThreads, AskForPrioritiesAndRunWithoutThem) {
  std::atomic<int> runs{0};
  std::atomic<int> policy{-1};
  MakeCounter("module", runs).action = [&](Doing&) {
    sched_param parameters{};
    int now = -1;
    pthread_getschedparam(pthread_self(), &now, &parameters);
    policy = now;
    ++runs;
  };
  auto& thread = CreateThread(runtime, "main", {.period = 1ms, .priority = 20});
  Ready();
  const Running running(scheduler);
  // The first cycle may come before the thread has its priority.
  const int runs_then = runs;
  WaitUntil("there has been a cycle with the priority", [&] { return runs > runs_then + 1; });
  const auto warnings = scheduler.Warnings();
  const bool is_told = std::ranges::any_of(warnings, [&](const Error& warning) {
    return warning.path == thread.path() && warning.message.starts_with("SCHED_FIFO");
  });
  EXPECT_EQ(policy == SCHED_FIFO, !is_told);
  for (const Error& warning : warnings) {
    EXPECT_FALSE(warning.message.empty());
    EXPECT_FALSE(warning.hint.empty());
    const bool is_of_the_thread = warning.message.starts_with("SCHED_FIFO");
    EXPECT_EQ(warning.path, is_of_the_thread ? thread.path() : "");
  }
  EXPECT_EQ(thread.options().priority, 20);
}

}  // namespace
}  // namespace runnel

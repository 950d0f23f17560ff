// How long tasks take, how old what chains publish is, and modules that are paused.

#include <gmock/gmock.h>

#include "plugins/scheduling/scheduler.h"
#include "tests/plugins/scheduling/counted_allocation.h"
#include "tests/plugins/scheduling/real_threads_fixture.h"
#include "tests/plugins/scheduling/test_modules.h"

namespace runnel {
namespace {

using testing::AllocationsOfThisThread;
using testing::Base;

/// Sensor, relay and actuator in two threads of simulated time: 10 ms, and 10 ms half a period later by its place.
class Measured : public ::testing::Test {
 protected:
  Measured() {
    sensor.action = [this](Doing& each) { each.out.Publish(1, scheduler.simulated_clock().Now() - 3ms); };
    actuator.action = [](Doing& each) { each.out.Publish(each.in.Read() ? *each.in.Read() : 0); };
    MustSucceed(Port::Connect(sensor.out, relay.in));
    MustSucceed(Port::Connect(relay.out, actuator.in));
    AssignThread(actuator, CreateThread(runtime, "slow", {.period = 20ms}));
    AssignThread(sensor, CreateThread(runtime, "fast", {.period = 10ms}));
    AssignThread(relay, *dynamic_cast<ThreadContainer*>(*runtime.root().Find("/threads/fast")));
    MustSucceed(runtime.MakeReady(runtime.root()));
  }

  Runtime runtime;
  Doing& sensor = runtime.Create<Doing>(runtime.root(), "sensor");
  Relay& relay = runtime.Create<Relay>(runtime.root(), "relay");
  Doing& actuator = runtime.Create<Doing>(runtime.root(), "actuator");
  Scheduler scheduler{runtime, {.clock = SchedulerOptions::ClockKind::kSimulated}};
};

TEST_F(Measured, TasksAreCountedInTheirOrderWhileSomebodyWantsToKnow) {
  scheduler.RunUntil(At(100));
  EXPECT_THAT(scheduler.ReadProfile().tasks, IsEmpty());
  EXPECT_FALSE(scheduler.profiled_for());
  {
    const Scheduler::ProfileUse use(scheduler);
    scheduler.RunUntil(At(200));
    const auto tasks = scheduler.ReadProfile().tasks;
    ASSERT_THAT(tasks, SizeIs(3));
    EXPECT_EQ(tasks[0].name(), "/actuator");
    EXPECT_EQ(tasks[0].times.runs, 5u);
    EXPECT_EQ(tasks[1].name(), "/sensor");
    EXPECT_EQ(tasks[1].thread, "/threads/fast");
    EXPECT_EQ(tasks[1].order, 1u);
    EXPECT_EQ(tasks[1].times.runs, 10u);
    EXPECT_EQ(tasks[2].order, 2u);
    EXPECT_GE(tasks[1].times.total, tasks[1].times.max);
    EXPECT_GE(tasks[1].times.max, tasks[1].times.last);
  }
  EXPECT_FALSE(scheduler.profiled_for());
  scheduler.SetProfiled(true);
  scheduler.RunUntil(At(300));
  EXPECT_EQ(scheduler.ReadProfile().tasks[1].times.runs, 10u) << "begins at nothing";
  EXPECT_THAT(ProfileText(scheduler.ReadProfile(), 1s), HasSubstr("/threads/fast  /relay\n"));
}

TEST_F(Measured, TheLatencyOfAChainIsThatOfTheFirstCommandAfterAMeasurement) {
  MustSucceed(scheduler.AddLatency({"/sensor/output/out", "/actuator/output/out"}));
  scheduler.RunUntil(At(1000));
  const auto latencies = scheduler.ReadLatencies();
  ASSERT_THAT(latencies, SizeIs(1));
  EXPECT_THAT(latencies[0].modules, ElementsAre("/sensor", "/relay", "/actuator"));
  // The slow thread is asked first at each time: what was measured at 7 ms and published at 10 ms is commanded at 20.
  EXPECT_EQ(latencies[0].times.last, 13ms);
  EXPECT_EQ(latencies[0].times.max, 13ms);
  EXPECT_EQ(latencies[0].times.runs, 49u);
}

TEST_F(Measured, AChainFollowsTheStructure) {
  MustSucceed(scheduler.AddLatency({"/sensor/out", "/actuator/out"}));
  scheduler.RunUntil(At(100));
  MustSucceed(Port::Disconnect(sensor.out, relay.in));
  const auto before = scheduler.ReadLatencies()[0].times.runs;
  scheduler.RunUntil(At(300));
  EXPECT_LE(scheduler.ReadLatencies()[0].times.runs, before + 1);
  EXPECT_THAT(scheduler.ReadLatencies()[0].modules, IsEmpty());
  MustSucceed(Port::Connect(sensor.out, actuator.in));
  scheduler.RunUntil(At(500));
  EXPECT_THAT(scheduler.ReadLatencies()[0].modules, ElementsAre("/sensor", "/actuator"));
  EXPECT_GT(scheduler.ReadLatencies()[0].times.runs, before + 5);
  MustSucceed(runtime.Delete(sensor));
  scheduler.RunUntil(At(600));
  EXPECT_THAT(scheduler.ReadLatencies()[0].modules, IsEmpty());
}

TEST_F(Measured, WhatCannotBeMeasuredIsTold) {
  EXPECT_THAT(scheduler.AddLatency({"/sensor/out", "/actuator/oot"}).error().hint, HasSubstr("out"));
  EXPECT_THAT(scheduler.AddLatency({"/actuator/out", "/sensor/out"}).error().message, HasSubstr("no data flow"));
  EXPECT_FALSE(scheduler.RemoveLatency({"/sensor/out", "/actuator/out"}));
  MustSucceed(scheduler.AddLatency({"/sensor/out", "/actuator/out"}));
  MustSucceed(scheduler.AddLatency({"/sensor/out", "/actuator/out"}));
  EXPECT_THAT(scheduler.ReadLatencies(), SizeIs(1));
  EXPECT_TRUE(scheduler.RemoveLatency({"/sensor/out", "/actuator/out"}));
  EXPECT_THAT(scheduler.ReadLatencies(), IsEmpty());
}

TEST_F(Measured, MeasuringAllocatesNothing) {
  MustSucceed(scheduler.AddLatency({"/sensor/out", "/actuator/out"}));
  scheduler.SetProfiled(true);
  scheduler.RunUntil(At(100));
  const int before = AllocationsOfThisThread();
  scheduler.RunUntil(At(1000));
  EXPECT_EQ(AllocationsOfThisThread(), before);
}

TEST_F(Measured, PausedModulesAreLeftOutUntilTheyGoOn) {
  const auto published = [&] { return relay.out.publications(); };
  scheduler.RunUntil(At(100));
  MustSucceed(scheduler.SetPaused("/relay", true));
  EXPECT_THAT(scheduler.PausedPaths(), ElementsAre("/relay"));
  const auto before = published();
  const auto sensed = sensor.out.publications();
  scheduler.RunUntil(At(200));
  EXPECT_EQ(published(), before);
  EXPECT_EQ(sensor.out.publications(), sensed + 10) << "others run on";
  MustSucceed(scheduler.SetPaused("/threads/fast", true));
  scheduler.RunUntil(At(300));
  EXPECT_EQ(sensor.out.publications(), sensed + 10) << "all that a thread runs";
  MustSucceed(scheduler.SetPaused("/relay", false));
  scheduler.RunUntil(At(400));
  EXPECT_EQ(published(), before) << "its thread is still paused";
  MustSucceed(scheduler.SetPaused("/threads/fast", false));
  scheduler.RunUntil(At(500));
  EXPECT_EQ(published(), before + 10);
  EXPECT_FALSE(scheduler.SetPaused("/nobody", true));
}

TEST_F(Measured, AThreadGetsAnotherPeriodWhileItRuns) {
  scheduler.RunUntil(At(100));
  auto& fast = *dynamic_cast<ThreadContainer*>(*runtime.root().Find("/threads/fast"));
  const auto before = sensor.out.publications();
  MustSucceed(fast.SetOptions({.period = 2ms}));
  scheduler.RunUntil(At(200));
  EXPECT_EQ(sensor.out.publications(), before + 50);
  EXPECT_FALSE(fast.SetOptions({.period = 0ms}));
  EXPECT_FALSE(fast.SetOptions({.priority = 100}));
  EXPECT_EQ(fast.options().period, 2ms);
}

TEST_F(RealThreads, GetAnotherPeriodAndArePausedWhileTheyRun) {
  std::atomic<int> count{0};
  auto& thread = CreateThread(runtime, "slow", {.period = 1h});
  AssignThread(MakeCounter("counter", count), thread);
  Ready();
  const Running running(scheduler);
  WaitUntil("the first cycle has run", [&] { return count == 1; });
  MustSucceed(thread.SetOptions({.period = 1ms}));
  WaitUntil("it runs once a millisecond", [&] { return count > 20; });
  MustSucceed(scheduler.SetPaused("/counter", true));
  const int paused = count;
  const auto cycles = thread.statistics().cycles;
  WaitUntil("the thread runs on", [&] { return thread.statistics().cycles > cycles + 10; });
  EXPECT_EQ(count, paused);
  MustSucceed(scheduler.SetPaused("/counter", false));
  WaitUntil("it goes on", [&] { return count > paused; });
}

}  // namespace
}  // namespace runnel

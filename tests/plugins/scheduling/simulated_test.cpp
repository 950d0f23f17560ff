#include <gmock/gmock.h>

#include "core/module/group.h"
#include "plugins/scheduling/scheduler.h"
#include "tests/plugins/scheduling/test_modules.h"
#include "tests/support/schedule_order.h"

namespace runnel {
namespace {

class Simulated : public ::testing::Test {
 protected:
  template <typename T>
  T& Make(const std::string& name) {
    return runtime.Create<T>(runtime.root(), name);
  }
  ThreadContainer& Thread(const std::string& name, Duration period) {
    return CreateThread(runtime, name, {.period = period});
  }
  void Ready() { MustSucceed(runtime.MakeReady(runtime.root())); }

  Runtime runtime;
  Scheduler scheduler{runtime, {.clock = SchedulerOptions::ClockKind::kSimulated}};
};

TEST_F(Simulated, RunsConnectedModulesInTheOrderOfTheData) {
  std::vector<std::string> diary;
  auto& last = Make<Relay>("last");
  auto& first = Make<Relay>("first");
  first.diary = last.diary = &diary;
  MustSucceed(Port::Connect(first.out, last.in));
  Thread("main", 10ms);
  Ready();
  ASSERT_TRUE(scheduler.Step());
  EXPECT_THAT(diary, ElementsAre("first", "last"));
  double result = 0;
  ASSERT_TRUE(last.out.VisitLatest([&](const void* value, Time) { result = *static_cast<const double*>(value); }));
  EXPECT_EQ(result, 2);  // the value went through both in one cycle
}

TEST_F(Simulated, KnowsWhetherAnythingHasTasksAndWhenItIsDue) {
  Thread("main", 10ms);
  EXPECT_FALSE(scheduler.HasTasks());
  Make<Doing>("module");
  Ready();
  EXPECT_TRUE(scheduler.HasTasks());
  EXPECT_EQ(scheduler.NextDue(), At(0));
  scheduler.Step();
  EXPECT_EQ(scheduler.NextDue(), At(10));
}

TEST_F(Simulated, RunsPeriodsAtTheirTimes) {
  auto& fast = Make<Doing>("fast");
  auto& slow = Make<Doing>("slow");
  std::vector<std::pair<std::string, std::int64_t>> runs;
  const auto note = [&](Doing& module) {
    runs.emplace_back(module.name(), module.cycle_time().time_since_epoch() / 1ms);
    EXPECT_EQ(module.cycle_period(), module.name() == "fast" ? 10ms : 20ms);
  };
  fast.action = slow.action = note;
  AssignThread(slow, Thread("slow", 20ms));
  AssignThread(fast, Thread("fast", 10ms));
  Ready();
  EXPECT_TRUE(scheduler.RunUntil(At(40)));
  using Run = std::pair<std::string, std::int64_t>;
  EXPECT_THAT(runs, ElementsAre(Run{"slow", 0}, Run{"fast", 0}, Run{"fast", 10}, Run{"slow", 20}, Run{"fast", 20},
                                Run{"fast", 30}));
  EXPECT_EQ(runtime.clock().Now(), At(40));
}

TEST_F(Simulated, RunsFreeRunningThreadsOncePerSimulatedDuration) {
  auto& module = Make<Doing>("module");
  int runs = 0;
  module.action = [&](Doing&) {
    ++runs;
    EXPECT_EQ(Doing::cycle_period(), 0ms);
  };
  CreateThread(runtime, "free", {.activation = ThreadOptions::Activation::kFreeRunning, .period = 2ms});
  Ready();
  scheduler.RunUntil(At(20));
  EXPECT_EQ(runs, 10);
}

TEST_F(Simulated, HasNothingToRunWithoutModules) {
  EXPECT_FALSE(scheduler.Step());
  EXPECT_TRUE(scheduler.RunUntil(At(5)));
  EXPECT_EQ(runtime.clock().Now(), At(5));
}

TEST_F(Simulated, MakesAContainerWhereNoneIs) {
  auto& module = Make<Doing>("module");
  int runs = 0;
  module.action = [&](Doing&) { ++runs; };
  Ready();
  EXPECT_TRUE(scheduler.Step());
  EXPECT_EQ(runs, 1);
  EXPECT_TRUE(runtime.root().Find("/threads/main"));
}

TEST_F(Simulated, DoesNotRunWhatIsNotReady) {
  Thread("main", 10ms);
  auto& module = Make<Doing>("module");
  int runs = 0;
  module.action = [&](Doing&) { ++runs; };
  scheduler.Step();
  EXPECT_EQ(runs, 0);
  Ready();
  scheduler.Step();
  EXPECT_EQ(runs, 1);
}

TEST_F(Simulated, AssignsGroupsAndLetsModulesOverride) {
  auto& group = runtime.Create<Group>(runtime.root(), "group");
  auto& inner = runtime.Create<Relay>(group, "inner");
  auto& other = runtime.Create<Relay>(group, "other");
  auto& outside = Make<Relay>("outside");
  auto& main = Thread("main", 10ms);
  auto& second = Thread("second", 10ms);
  auto& third = Thread("third", 10ms);
  AssignThread(group, second);
  AssignThread(other, third);
  Ready();
  const auto only = [&](const Module& module) {
    return ElementsAre(test::ScheduledTask{module.path(), Phase::kUpdate});
  };
  EXPECT_THAT(test::OrderOf(scheduler, main), only(outside));
  EXPECT_THAT(test::OrderOf(scheduler, second), only(inner));
  EXPECT_THAT(test::OrderOf(scheduler, third), only(other));
  AssignThread(other, main);
  EXPECT_THAT(test::OrderOf(scheduler, third), IsEmpty());
  EXPECT_THAT(test::OrderOf(scheduler, main), SizeIs(2));
}

TEST_F(Simulated, SendsWhatIsAssignedToNobodyToTheDefaultThread) {
  Runtime other;
  Scheduler with_default(other, {.clock = SchedulerOptions::ClockKind::kSimulated, .default_thread = "second"});
  auto& first = CreateThread(other, "first");
  auto& second = CreateThread(other, "second");
  other.Create<Relay>(other.root(), "module");
  MustSucceed(other.MakeReady(other.root()));
  EXPECT_THAT(test::OrderOf(with_default, first), IsEmpty());
  EXPECT_THAT(test::OrderOf(with_default, second), SizeIs(1));
}

TEST_F(Simulated, GivesTheModulesOfADeletedContainerToAnother) {
  auto& module = Make<Relay>("module");
  auto& main = Thread("main", 10ms);
  auto& second = Thread("second", 10ms);
  AssignThread(module, second);
  Ready();
  scheduler.Step();
  MustSucceed(runtime.Delete(second));
  EXPECT_THAT(test::OrderOf(scheduler, main), SizeIs(1));
  EXPECT_TRUE(scheduler.Step());
}

TEST_F(Simulated, ReordersWhenAConnectionChanges) {
  auto& a = Make<Relay>("a");
  auto& b = Make<Relay>("b");
  auto& main = Thread("main", 10ms);
  Ready();
  const test::ScheduledTask task_a{"/a", Phase::kUpdate};
  const test::ScheduledTask task_b{"/b", Phase::kUpdate};
  EXPECT_THAT(test::OrderOf(scheduler, main), ElementsAre(task_a, task_b));
  MustSucceed(Port::Connect(b.out, a.in));
  EXPECT_THAT(test::OrderOf(scheduler, main), ElementsAre(task_b, task_a));
  // What still agrees with the data flow stays as it is.
  MustSucceed(Port::Disconnect(b.out, a.in));
  EXPECT_THAT(test::OrderOf(scheduler, main), ElementsAre(task_b, task_a));
  MustSucceed(Port::Connect(a.out, b.in));
  EXPECT_THAT(test::OrderOf(scheduler, main), ElementsAre(task_a, task_b));
}

TEST_F(Simulated, TellsOfLoopsThatWereCut) {
  auto& a = Make<Relay>("a");
  auto& b = Make<Relay>("b");
  MustSucceed(Port::Connect(a.out, b.in));
  MustSucceed(Port::Connect(b.out, a.in));
  Thread("main", 10ms);
  Ready();
  const auto warnings = scheduler.Warnings();
  ASSERT_THAT(warnings, SizeIs(1));
  EXPECT_THAT(warnings[0].message, HasSubstr("/b/output/out"));
  EXPECT_THAT(warnings[0].message, HasSubstr("/a/input/in"));
}

TEST_F(Simulated, WarnsOfWhatHasNotBeenMadeReady) {
  Make<Relay>("a");
  Thread("main", 10ms);
  const auto warnings = scheduler.Warnings();
  ASSERT_THAT(warnings, SizeIs(1));
  EXPECT_EQ(warnings[0].path, "/a");
  EXPECT_THAT(warnings[0].message, HasSubstr("has not been made ready"));
  Ready();
  EXPECT_THAT(scheduler.Warnings(), SizeIs(0));
}

TEST_F(Simulated, AConnectionThatIsLateSaysNothingOfTheOrder) {
  std::vector<std::string> diary;
  auto& a = Make<Relay>("a");
  auto& b = Make<Relay>("b");
  a.diary = b.diary = &diary;
  MustSucceed(Port::Connect(a.out, b.in, {.late = true}));
  MustSucceed(Port::Connect(b.out, a.in));
  Thread("main", 10ms);
  Ready();
  EXPECT_THAT(scheduler.Warnings(), IsEmpty()) << "the file says which one is late";
  scheduler.Step();
  EXPECT_THAT(diary, ElementsAre("b", "a"));
  MustSucceed(Port::Disconnect(a.out, b.in));
  MustSucceed(Port::Connect(a.out, b.in));
  EXPECT_THAT(scheduler.Warnings(), SizeIs(1));
}

TEST_F(Simulated, RefusesToStartThreads) {
  const auto started = scheduler.Start();
  ASSERT_FALSE(started);
  EXPECT_THAT(started.error().hint, HasSubstr("Step()"));
}

// A small application with two rates, a loop and a triggered module, and all that it computed.
std::vector<std::pair<std::int64_t, double>> RunApplication() {
  Runtime runtime;
  Scheduler scheduler(runtime, {.clock = SchedulerOptions::ClockKind::kSimulated});
  std::vector<std::pair<std::int64_t, double>> seen;
  auto& a = runtime.Create<Relay>(runtime.root(), "a");
  auto& b = runtime.Create<Relay>(runtime.root(), "b");
  auto& c = runtime.Create<Doing>(runtime.root(), "c");
  c.action = [&](Doing& module) {
    const double value = *module.in.Read();
    seen.emplace_back(module.cycle_time().time_since_epoch().count(), value);
    module.out.Publish(value / 3);
  };
  MustSucceed(Port::Connect(a.out, b.in));
  MustSucceed(Port::Connect(b.out, c.in));
  MustSucceed(Port::Connect(c.out, a.in));
  AssignThread(a, CreateThread(runtime, "a", {.period = 7ms}));
  AssignThread(b, CreateThread(runtime, "b", {.period = 11ms}));
  AssignThread(c, CreateThread(runtime, "c", {.activation = ThreadOptions::Activation::kTrigger}));
  MustSucceed(runtime.MakeReady(runtime.root()));
  scheduler.RunUntil(At(1000));
  return seen;
}

TEST(SimulatedApplication, ComputesTheSameEveryTime) {
  const auto once = RunApplication();
  EXPECT_THAT(once, SizeIs(91));  // one for each cycle of b: 0, 11 … 990 ms
  EXPECT_EQ(once, RunApplication());
}

/// Reads an old measurement; beside it one that reads nothing.
struct Aged final : Module {
  using Module::Module;
  Input<double> scan{this, "scan", {.ageing = Ageing::kTimesOut}};
  Output<double> out{this, "out"};

 private:
  void Update() override {
    (void)scan.Read();
    out.Publish(1);
  }
};

TEST(SimulatedApplication, WhatAModuleReadsAgesNothingThatTheNextOnePublishes) {
  Runtime runtime;
  Scheduler scheduler(runtime, {.clock = SchedulerOptions::ClockKind::kSimulated});
  auto& laser = runtime.Create<testing::Feeder>(runtime.root(), "laser");
  auto& aged = runtime.Create<Aged>(runtime.root(), "aged");
  auto& next = runtime.Create<Relay>(runtime.root(), "next");
  MustSucceed(Port::Connect(laser.out, aged.scan));
  MustSucceed(Port::Connect(aged.out, next.in));  // so it runs after it
  MustSucceed(runtime.MakeReady(runtime.root()));
  laser.out.Publish(1, At(0));
  scheduler.RunUntil(At(100));
  const auto stamp = [](const Port& port) {
    Time found{};
    port.VisitLatest([&](const void*, ValueTimes times) { found = times.timestamp; });
    return found;
  };
  EXPECT_EQ(stamp(aged.out), At(0));
  EXPECT_EQ(stamp(next.out), At(90));
}

}  // namespace
}  // namespace runnel

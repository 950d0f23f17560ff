#include <gmock/gmock.h>

#include "plugins/scheduling/scheduler.h"
#include "tests/plugins/scheduling/test_modules.h"
#include "tests/support/schedule_order.h"

namespace runnel {
namespace {

class Triggered : public ::testing::Test {
 protected:
  Triggered() {
    source.action = [this](Doing& module) {
      diary.push_back("source");
      if (publishes) module.out.Publish(1);
    };
    listener.action = [this](Doing& module) {
      const auto ms = module.cycle_time().time_since_epoch() / 1ms;
      diary.push_back("listener " + std::to_string(ms));
      if (module.in.Read()) module.out.Publish(2);
    };
    MustSucceed(Port::Connect(source.out, listener.in));
    AssignThread(source, periodic);
    AssignThread(listener, waiting);
  }
  void Ready() { MustSucceed(runtime.MakeReady(runtime.root())); }

  Runtime runtime;
  Scheduler scheduler{runtime, {.clock = SchedulerOptions::ClockKind::kSimulated}};
  ThreadContainer& periodic = CreateThread(runtime, "periodic", {.period = 10ms});
  ThreadContainer& waiting = CreateThread(runtime, "waiting", {.activation = ThreadOptions::Activation::kTrigger});
  Doing& listener = runtime.Create<Doing>(runtime.root(), "listener");
  Doing& source = runtime.Create<Doing>(runtime.root(), "source");
  Diary diary;
  bool publishes = true;
};

TEST_F(Triggered, RunsAfterTheCycleThatPublishedAtTheSameTime) {
  auto& late = runtime.Create<Relay>(runtime.root(), "late");  // after the source in its cycle
  late.diary = &diary;
  Ready();
  scheduler.RunUntil(At(20));
  EXPECT_THAT(diary, ElementsAre("source", "late", "listener 0", "source", "late", "listener 10"));
}

TEST_F(Triggered, DoesNotRunWithoutData) {
  publishes = false;
  Ready();
  scheduler.RunUntil(At(20));
  EXPECT_THAT(diary, ElementsAre("source", "source"));
}

TEST_F(Triggered, IsSetOffByDataFromOutsideOfCycles) {
  publishes = false;
  Ready();
  scheduler.RunUntil(At(15));
  diary.clear();
  source.out.Publish(5);
  EXPECT_TRUE(scheduler.Step());
  EXPECT_THAT(diary, ElementsAre("listener 15"));
}

TEST_F(Triggered, FindsDataThatCameBeforeItWasReady) {
  publishes = false;
  source.out.Publish(5);
  Ready();
  scheduler.Step();
  EXPECT_THAT(diary, ElementsAre("listener 0"));
}

TEST_F(Triggered, RunsForDataThatANewConnectionBrings) {
  publishes = false;
  auto& other = runtime.Create<Relay>(runtime.root(), "other");
  other.out.Publish(5);
  Ready();
  scheduler.RunUntil(At(15));
  diary.clear();
  MustSucceed(Port::Connect(other.out, listener.in));
  EXPECT_TRUE(scheduler.Step());
  EXPECT_THAT(diary, ElementsAre("listener 15"));
}

TEST_F(Triggered, RunsOnceForDataThatCameBeforeItWasAdded) {
  Ready();
  scheduler.Step();
  auto& added = runtime.Create<Doing>(runtime.root(), "added");
  added.action = [&](Doing&) { diary.push_back("added"); };
  AssignThread(added, waiting);
  MustSucceed(Port::Connect(source.out, added.in));
  MustSucceed(runtime.MakeReady(added));
  diary.clear();
  const auto cycles = waiting.statistics().cycles;
  EXPECT_TRUE(scheduler.Step());
  EXPECT_THAT(diary, ElementsAre("added"));
  EXPECT_EQ(waiting.statistics().cycles, cycles + 1);
}

TEST_F(Triggered, RunsAChainInOnePassAlongTheData) {
  auto& second = runtime.Create<Doing>(runtime.root(), "second");
  second.action = [&](Doing&) { diary.push_back("second"); };
  AssignThread(second, waiting);
  MustSucceed(Port::Connect(listener.out, second.in));
  Ready();
  scheduler.Step();
  EXPECT_THAT(diary, ElementsAre("source", "listener 0", "second"));
  EXPECT_EQ(waiting.statistics().cycles, 1u);
}

TEST_F(Triggered, SetsOffOtherThreadsInTheOrderOfTheirMaking) {
  auto& other = CreateThread(runtime, "other", {.activation = ThreadOptions::Activation::kTrigger});
  auto& second = runtime.Create<Doing>(runtime.root(), "second");
  second.action = [&](Doing&) { diary.push_back("second"); };
  AssignThread(second, other);
  MustSucceed(Port::Connect(listener.out, second.in));
  MustSucceed(Port::Connect(source.out, second.in));
  Ready();
  scheduler.Step();
  EXPECT_THAT(diary, ElementsAre("source", "listener 0", "second"));
}

TEST_F(Triggered, LetsTimePassDespiteModulesThatSetThemselvesOffForEver) {
  MustSucceed(Port::Connect(listener.out, listener.in));
  Ready();
  EXPECT_TRUE(scheduler.Step());
  EXPECT_EQ(waiting.statistics().cycles, static_cast<std::uint64_t>(SimulatedExecutor::kMostTriggeredCycles));
  EXPECT_TRUE(scheduler.RunUntil(At(30)));
  EXPECT_EQ(periodic.statistics().cycles, 3u);
  const auto faults = scheduler.TakeFaults();
  ASSERT_THAT(faults, SizeIs(1));
  EXPECT_EQ(faults[0].path, "/threads/waiting");
}

TEST_F(Triggered, WarnsOfAModuleThatNothingCanSetOff) {
  auto& deaf = runtime.Create<Relay>(runtime.root(), "deaf");
  AssignThread(deaf, waiting);
  Ready();
  const auto warnings = scheduler.Warnings();
  ASSERT_THAT(warnings, SizeIs(1));
  EXPECT_EQ(warnings[0].path, "/deaf");
  EXPECT_THAT(warnings[0].message, HasSubstr("never run"));
}

TEST_F(Triggered, WarnsOfAModuleForWhichNobodyHasChosenAThread) {
  auto& unassigned = runtime.Create<Relay>(runtime.root(), "unassigned");
  Ready();
  const auto warnings = scheduler.Warnings();
  ASSERT_THAT(warnings, SizeIs(1));
  EXPECT_EQ(warnings[0].path, "/unassigned");
  EXPECT_THAT(warnings[0].message, HasSubstr("/threads/periodic runs it"));
  AssignThread(unassigned, periodic);
  EXPECT_THAT(scheduler.Warnings(), IsEmpty());
}

TEST_F(Triggered, BecomesPeriodicWhenAssignedToAPeriodicThread) {
  publishes = false;
  Ready();
  scheduler.Step();
  EXPECT_THAT(diary, ElementsAre("source"));
  AssignThread(listener, periodic);
  diary.clear();
  scheduler.Step();
  EXPECT_THAT(diary, ElementsAre("source", "listener 10"));
  EXPECT_THAT(test::OrderOf(scheduler, waiting), IsEmpty());
}

TEST_F(Triggered, RunsForDataThatCameBeforeItMovedToAnotherThread) {
  publishes = false;
  auto& other = CreateThread(runtime, "other", {.activation = ThreadOptions::Activation::kTrigger});
  Ready();
  scheduler.Step();
  source.out.Publish(5);
  AssignThread(listener, other);
  diary.clear();
  EXPECT_TRUE(scheduler.Step());
  EXPECT_TRUE(scheduler.Step());
  EXPECT_THAT(diary, ::testing::Contains("listener 0"));
}

TEST_F(Triggered, CanBeDeletedAndPublishedToAfterwards) {
  Ready();
  scheduler.Step();
  MustSucceed(runtime.Delete(listener));
  diary.clear();
  scheduler.Step();
  EXPECT_THAT(diary, ElementsAre("source"));
}

}  // namespace
}  // namespace runnel

// What begins the cycles of a thread is changed while it runs.

#include <atomic>
#include <thread>

#include "plugins/scheduling/scheduler.h"
#include "tests/plugins/scheduling/real_threads_fixture.h"

namespace runnel {
namespace {

using testing::At;
using testing::Diary;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Activation = ThreadOptions::Activation;

class OtherActivation : public ::testing::Test {
 protected:
  OtherActivation() {
    source.action = [this](Doing& module) {
      if (publishes) module.out.Publish(1);
    };
    listener.action = [this](Doing& module) {
      diary.push_back(std::to_string(module.cycle_time().time_since_epoch() / 1ms));
    };
    MustSucceed(Port::Connect(source.out, listener.in));
    AssignThread(source, periodic);
    AssignThread(listener, other);
    MustSucceed(runtime.MakeReady(runtime.root()));
  }
  // What the listener has run at until then.
  Diary RunUntil(int milliseconds) {
    diary.clear();
    scheduler.RunUntil(At(milliseconds));
    return diary;
  }

  Runtime runtime;
  Scheduler scheduler{runtime, {.clock = SchedulerOptions::ClockKind::kSimulated}};
  ThreadContainer& periodic = CreateThread(runtime, "periodic", {.period = 10ms});
  ThreadContainer& other = CreateThread(runtime, "other", {.period = 4ms});
  Doing& source = runtime.Create<Doing>(runtime.root(), "source");
  Doing& listener = runtime.Create<Doing>(runtime.root(), "listener");
  Diary diary;
  bool publishes = true;
};

TEST_F(OtherActivation, FromAPeriodToDataAndBack) {
  EXPECT_THAT(RunUntil(10), ElementsAre("0", "4", "8"));
  MustSucceed(other.SetOptions({.activation = Activation::kTrigger}));
  EXPECT_EQ(other.options().activation, Activation::kTrigger);
  EXPECT_THAT(RunUntil(30), ElementsAre("10", "10", "20")) << "what has come before sets it off, too";
  publishes = false;
  EXPECT_THAT(RunUntil(50), IsEmpty());
  MustSucceed(other.SetOptions({.period = 5ms}));
  EXPECT_THAT(RunUntil(60), ElementsAre("50", "55"));
  EXPECT_FALSE(other.SetOptions({.period = 0ms}));
  EXPECT_FALSE(other.SetOptions({.activation = Activation::kFreeRunning, .period = 0ms}));
}

TEST_F(OtherActivation, ToFreeRunningWhereACycleTakesThePeriod) {
  EXPECT_THAT(RunUntil(5), ElementsAre("0", "4"));
  MustSucceed(other.SetOptions({.activation = Activation::kFreeRunning, .period = 2ms}));
  EXPECT_THAT(RunUntil(10), ElementsAre("7", "9"));
  MustSucceed(other.SetOptions({.activation = Activation::kTrigger}));
  publishes = false;
  scheduler.RunUntil(At(11));
  EXPECT_THAT(RunUntil(40), IsEmpty());
}

TEST_F(OtherActivation, OfAThreadBeforeItsFirstCycle) {
  MustSucceed(other.SetOptions({.activation = Activation::kTrigger}));
  EXPECT_THAT(RunUntil(20), ElementsAre("0", "10"));
}

TEST_F(OtherActivation, ModulesThatDataCannotSetOffAreTold) {
  runtime.Create<Relay>(runtime.root(), "relay");
  AssignThread(**runtime.root().Find("/relay"), other);
  MustSucceed(runtime.MakeReady(runtime.root()));
  RunUntil(10);
  EXPECT_THAT(scheduler.Warnings(), IsEmpty());
  MustSucceed(other.SetOptions({.activation = Activation::kTrigger}));
  const auto warnings = scheduler.Warnings();
  ASSERT_THAT(warnings, SizeIs(1));
  EXPECT_THAT(warnings[0].ToString(), HasSubstr("/relay: is never run: its thread /threads/other waits for data"));
}

TEST_F(RealThreads, BeginTheirCyclesOtherwiseWhileTheyRun) {
  std::atomic<int> count{0};
  auto& feeder = runtime.Create<testing::Feeder>(runtime.root(), "feeder");
  auto& counter = MakeCounter("counter", count);
  MustSucceed(Port::Connect(feeder.out, counter.in));
  auto& thread = CreateThread(runtime, "thread", {.period = 1h});
  AssignThread(counter, thread);
  Ready();
  const Running running(scheduler);
  WaitUntil("the first cycle has run", [&] { return count == 1; });
  for (int round = 0; round < 20; ++round) {
    MustSucceed(thread.SetOptions({.activation = Activation::kTrigger}));
    int before = count;
    feeder.out.Publish(round);
    WaitUntil("data sets it off", [&] { return count > before; });
    MustSucceed(thread.SetOptions({.activation = Activation::kFreeRunning}));
    before = count;
    WaitUntil("it runs freely", [&] { return count > before + 10; });
    MustSucceed(thread.SetOptions({.period = 1ms}));
    before = count;
    WaitUntil("it runs once a millisecond", [&] { return count > before + 3; });
    MustSucceed(thread.SetOptions({.activation = Activation::kFreeRunning}));
    MustSucceed(thread.SetOptions({.activation = Activation::kTrigger}));
    before = count;
    feeder.out.Publish(round);
    WaitUntil("the last of several changes counts", [&] { return count > before; });
  }
  EXPECT_EQ(thread.options().activation, Activation::kTrigger);
}

// What is published meanwhile sets it off: the change falls between any two instructions of a publisher.
TEST_F(RealThreads, MissNoDataWhileTheyBeginToWaitForIt) {
  std::atomic<int> seen{0};
  auto& feeder = runtime.Create<testing::Feeder>(runtime.root(), "feeder");
  auto& reader = runtime.Create<Doing>(runtime.root(), "reader");
  reader.action = [&](Doing& module) { seen = static_cast<int>(*module.in.Read()); };
  MustSucceed(Port::Connect(feeder.out, reader.in));
  feeder.out.Publish(0);
  auto& thread = CreateThread(runtime, "thread", {.period = 1h});
  AssignThread(reader, thread);
  Ready();
  const Running running(scheduler);
  for (int round = 1; round <= 200; ++round) {
    std::thread publisher([&] { feeder.out.Publish(round); });
    MustSucceed(thread.SetOptions({.activation = Activation::kTrigger}));
    publisher.join();
    WaitUntil("the value has been seen", [&] { return seen == round; });
    MustSucceed(thread.SetOptions({.period = 1h}));
  }
}

}  // namespace
}  // namespace runnel

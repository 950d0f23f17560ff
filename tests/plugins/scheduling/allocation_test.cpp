#include <atomic>

#include <gmock/gmock.h>

#include "plugins/scheduling/scheduler.h"
#include "tests/plugins/scheduling/counted_allocation.h"
#include "tests/plugins/scheduling/test_modules.h"
#include "tests/support/wait_until.h"

namespace runnel {
namespace {

using test::WaitUntil;
using testing::AllocationsOfThisThread;

// A periodic thread with a loop and a thread that waits for its data.
struct Application {
  explicit Application(SchedulerOptions::ClockKind clock) : scheduler(runtime, {.clock = clock}) {
    MustSucceed(Port::Connect(relay.out, module.in));
    MustSucceed(Port::Connect(module.out, relay.in, {.queue = 2}));
    MustSucceed(Port::Connect(module.out, listener.in));
    auto& waiting = CreateThread(runtime, "waiting", {.activation = ThreadOptions::Activation::kTrigger});
    AssignThread(listener, waiting);
    AssignThread(relay, CreateThread(runtime, "periodic", {.period = 1ms}));
    AssignThread(module, *dynamic_cast<ThreadContainer*>(*runtime.root().Find("/threads/periodic")));
    module.action = [](Doing& each) { each.out.Publish(each.in.Read() ? 1 : 0); };
    MustSucceed(runtime.MakeReady(runtime.root()));
  }

  Runtime runtime;
  Relay& relay = runtime.Create<Relay>(runtime.root(), "relay");
  Doing& module = runtime.Create<Doing>(runtime.root(), "module");
  Doing& listener = runtime.Create<Doing>(runtime.root(), "listener");
  Scheduler scheduler;
};

TEST(Cycles, AllocateNothingOnTheSimulatedClock) {
  Application application(SchedulerOptions::ClockKind::kSimulated);
  int heard = 0;
  application.listener.action = [&](Doing&) { ++heard; };
  application.scheduler.RunUntil(At(10));
  const int before = AllocationsOfThisThread();
  application.scheduler.RunUntil(At(200));
  EXPECT_EQ(AllocationsOfThisThread(), before);
  EXPECT_EQ(heard, 200);
}

TEST(Cycles, AllocateNothingInRealThreads) {
  Application application(SchedulerOptions::ClockKind::kReal);
  std::atomic<int> heard{0};
  std::atomic<int> allocations{0};
  const auto count = [&](int& first) {
    if (first < 0) first = AllocationsOfThisThread();
    allocations += AllocationsOfThisThread() - first;
  };
  application.listener.action = [&, first = -1](Doing&) mutable {
    count(first);
    ++heard;
  };
  application.module.action = [&, first = -1](Doing& each) mutable {
    count(first);
    each.out.Publish(1);
  };
  MustSucceed(application.scheduler.Start());
  WaitUntil("data have come twenty times", [&] { return heard >= 20; });
  application.scheduler.Stop();
  EXPECT_EQ(allocations, 0);
}

TEST(Cycles, AllocationsWouldBeCounted) {
  const int before = AllocationsOfThisThread();
  delete new int(5);
  const std::string text(100, 'x');
  EXPECT_GT(AllocationsOfThisThread(), before);
}

}  // namespace
}  // namespace runnel

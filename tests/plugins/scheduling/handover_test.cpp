// An element is never run by two threads at once, not even while it moves between them.

#include <atomic>
#include <thread>

#include "tests/plugins/scheduling/real_threads_fixture.h"

namespace runnel {
namespace {

constexpr ThreadOptions kFree{.activation = ThreadOptions::Activation::kFreeRunning};
constexpr ThreadOptions kTrigger{.activation = ThreadOptions::Activation::kTrigger};

/// Stands still in Update() from the first time on until it may go on.
struct Gate {
  std::atomic<int> entered{0};
  std::atomic<bool> open{false};
  void Pass() {
    ++entered;
    WaitUntil("the gate is opened", [this] { return open.load(); });
  }
};

/// Notices when two threads are in it at once.
struct Watched {
  void Pass() {
    if (inside.exchange(true, std::memory_order_relaxed)) overlaps = true;
    ++unguarded;
    ++runs;
    inside.store(false, std::memory_order_relaxed);
  }
  std::atomic<bool> inside{false};
  std::atomic<bool> overlaps{false};
  std::atomic<int> runs{0};
  int unguarded = 0;  // for ThreadSanitizer
};

class Handover : public RealThreads {
 protected:
  // A thread that counts its cycles by a module of its own, the first in each.
  ThreadContainer& MakeThread(const std::string& name, std::atomic<int>& cycles, const ThreadOptions& options = kFree) {
    auto& thread = CreateThread(runtime, name, options);
    AssignThread(MakeCounter("counter_of_" + name, cycles), thread);
    return thread;
  }
  // Or until two threads stand before the gate, which a test has to find then.
  void WaitForCycles(const std::atomic<int>& cycles, int count = 20) {
    const int before = cycles;
    WaitUntil("the thread has run further cycles", [&] { return cycles > before + count || gate.entered > 1; });
  }

  std::atomic<int> cycles_of_a{0};
  std::atomic<int> cycles_of_b{0};
  std::atomic<int> cycles_of_c{0};
  Gate gate;
};

TEST_F(Handover, WaitsForTheEndOfTheCycleOfTheOldThread) {
  auto& a = MakeThread("a", cycles_of_a);
  auto& b = MakeThread("b", cycles_of_b);
  auto& module = runtime.Create<Doing>(runtime.root(), "module");
  module.action = [&](Doing&) { gate.Pass(); };
  AssignThread(module, a);
  Ready();
  const Running running(scheduler);
  WaitUntil("the module is in its cycle", [&] { return gate.entered > 0; });
  AssignThread(module, b);
  WaitForCycles(cycles_of_b);
  EXPECT_EQ(gate.entered, 1);  // the rest of b has gone on without it
  gate.open = true;
  WaitUntil("the new thread runs the module", [&] { return gate.entered > 1; });
}

TEST_F(Handover, WaitsForTheFirstOfSeveralThreadsToo) {
  auto& a = MakeThread("a", cycles_of_a);
  auto& b = MakeThread("b", cycles_of_b);
  auto& c = MakeThread("c", cycles_of_c);
  auto& module = runtime.Create<Doing>(runtime.root(), "module");
  module.action = [&](Doing&) { gate.Pass(); };
  AssignThread(module, a);
  Ready();
  const Running running(scheduler);
  WaitUntil("the module is in its cycle", [&] { return gate.entered > 0; });
  for (int round = 0; round < 3; ++round) {
    AssignThread(module, b);
    WaitForCycles(cycles_of_b);
    AssignThread(module, c);
    WaitForCycles(cycles_of_c);
  }
  EXPECT_EQ(gate.entered, 1);
  gate.open = true;
  WaitUntil("the new thread runs the module", [&] { return gate.entered > 1; });
}

TEST_F(Handover, AndBackAgainWaitsForNobody) {
  auto& a = MakeThread("a", cycles_of_a);
  auto& b = MakeThread("b", cycles_of_b);
  auto& module = runtime.Create<Doing>(runtime.root(), "module");
  module.action = [&](Doing&) { gate.Pass(); };
  AssignThread(module, a);
  Ready();
  const Running running(scheduler);
  WaitUntil("the module is in its cycle", [&] { return gate.entered > 0; });
  AssignThread(module, b);
  AssignThread(module, a);
  WaitForCycles(cycles_of_b);
  EXPECT_EQ(gate.entered, 1);
  gate.open = true;
  WaitUntil("the new thread runs the module", [&] { return gate.entered > 1; });
}

TEST_F(Handover, OfAThreadThatIsDeletedWaitsForItsCycle) {
  auto& a = MakeThread("a", cycles_of_a);
  MakeThread("b", cycles_of_b);
  auto& module = runtime.Create<Doing>(runtime.root(), "module");
  module.action = [&](Doing&) { gate.Pass(); };
  AssignThread(module, a);
  Ready();
  const Running running(scheduler);
  WaitUntil("the module is in its cycle", [&] { return gate.entered > 0; });
  std::thread deletion([&] { MustSucceed(runtime.Delete(a)); });
  // The module falls to b; a's thread is still in it.
  WaitForCycles(cycles_of_b, 1000);
  EXPECT_EQ(gate.entered, 1);
  gate.open = true;
  deletion.join();
  WaitUntil("the new thread runs the module", [&] { return gate.entered > 1; });
}

TEST_F(Handover, DoesNotForgetTheDataThatCameMeanwhile) {
  auto& a = MakeThread("a", cycles_of_a);
  auto& waiting = CreateThread(runtime, "waiting", kTrigger);
  auto& source = runtime.Create<testing::Feeder>(runtime.root(), "source");
  auto& module = runtime.Create<Doing>(runtime.root(), "module");
  std::atomic<double> received{0};
  module.action = [&](Doing& each) {
    if (const auto read = each.in.Read()) received = *read;
    gate.Pass();
  };
  MustSucceed(Port::Connect(source.out, module.in));
  AssignThread(module, a);
  MustSucceed(runtime.MakeReady(module));
  MustSucceed(runtime.MakeReady(*dynamic_cast<FrameworkElement*>(*runtime.root().Find("/counter_of_a"))));
  const Running running(scheduler);
  WaitUntil("the module is in its cycle", [&] { return gate.entered > 0; });
  AssignThread(module, waiting);
  source.out.Publish(5);
  WaitUntil("the new thread has looked a few times",
            [&] { return waiting.statistics().cycles > 3 || gate.entered > 1; });
  EXPECT_EQ(gate.entered, 1);
  gate.open = true;
  WaitUntil("the value that came meanwhile is received", [&] { return received == 5; });
}

// Both threads run as fast as they can, and two modules change places between them all the time.
TEST_F(Handover, ThousandsOfTimesNeverRunsAnElementTwiceAtOnce) {
  auto& a = MakeThread("a", cycles_of_a);
  auto& b = MakeThread("b", cycles_of_b);
  Watched watched[2];
  auto& first = runtime.Create<Doing>(runtime.root(), "first");
  auto& second = runtime.Create<Doing>(runtime.root(), "second");
  first.action = [&](Doing&) { watched[0].Pass(); };
  second.action = [&](Doing&) { watched[1].Pass(); };
  Ready();
  const Running running(scheduler);
  for (int round = 0; round < 3000; ++round) {
    AssignThread(first, round % 2 == 0 ? a : b);
    AssignThread(second, round % 2 == 0 ? b : a);
  }
  for (const Watched& each : watched) {
    const int before = each.runs;
    WaitUntil("the module still runs", [&] { return each.runs > before; });
  }
  scheduler.Stop();
  for (const Watched& each : watched) {
    EXPECT_FALSE(each.overlaps);
    EXPECT_EQ(each.unguarded, each.runs);
  }
}

}  // namespace
}  // namespace runnel

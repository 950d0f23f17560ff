// Modules that run on data, and changes of the structure while real threads run: what is there already
// when a module is added or connected sets it off, as no publisher tells of it any more.

#include <atomic>
#include <memory>

#include "tests/plugins/scheduling/real_threads_fixture.h"

namespace runnel {
namespace {

class TriggeredByAChange : public RealThreads {
 protected:
  TriggeredByAChange() { Ready(); }

  Doing& MakeSink(std::shared_ptr<std::atomic<int>> runs) {
    auto& sink = runtime.Create<Doing>(runtime.root(), "sink");
    sink.action = [runs](Doing&) { ++*runs; };
    return sink;
  }
  // Until the thread has taken and used up whatever has woken it so far.
  void WaitUntilIdle() {
    WaitUntil("the waiting thread has nothing more to do", [&] { return !waiting.runner()->is_activated(); });
  }

  ThreadContainer& waiting = CreateThread(runtime, "waiting", {.activation = ThreadOptions::Activation::kTrigger});
  testing::Feeder& source = runtime.Create<testing::Feeder>(runtime.root(), "source");
};

TEST_F(TriggeredByAChange, AModuleThatIsAddedFindsTheDataThatIsThere) {
  const Running running(scheduler);
  source.out.Publish(1);
  for (int round = 0; round < 300; ++round) {
    const auto runs = std::make_shared<std::atomic<int>>(0);
    auto& sink = MakeSink(runs);
    MustSucceed(Port::Connect(source.out, sink.in));
    MustSucceed(runtime.MakeReady(sink));
    WaitUntil("the value that was there sets the added module off", [&] { return *runs > 0; });
    MustSucceed(runtime.Delete(sink));
  }
}

TEST_F(TriggeredByAChange, AModuleThatIsAddedWithinALargerChangeFindsTheDataThatIsThere) {
  const auto runs = std::make_shared<std::atomic<int>>(0);
  const Running running(scheduler);
  source.out.Publish(1);
  {
    const ChangeScope one_change(runtime);
    auto& sink = MakeSink(runs);
    MustSucceed(Port::Connect(source.out, sink.in));
    MustSucceed(runtime.MakeReady(sink));
    WaitUntilIdle();  // the thread has looked, before there was anything to find
  }
  WaitUntil("the value that was there sets the added module off", [&] { return *runs > 0; });
}

TEST_F(TriggeredByAChange, AModuleIsSetOffByDataThatComesBeforeTheChangeIsWhole) {
  const auto runs = std::make_shared<std::atomic<int>>(0);
  const Running running(scheduler);
  {
    const ChangeScope one_change(runtime);
    auto& sink = MakeSink(runs);
    MustSucceed(Port::Connect(source.out, sink.in));
    MustSucceed(runtime.MakeReady(sink));
    source.out.Publish(1);
    WaitUntilIdle();
  }
  WaitUntil("the value that came meanwhile sets the added module off", [&] { return *runs > 0; });
}

TEST_F(TriggeredByAChange, AModuleThatIsConnectedFindsTheDataThatIsThere) {
  const auto runs = std::make_shared<std::atomic<int>>(0);
  auto& sink = MakeSink(runs);
  MustSucceed(runtime.MakeReady(sink));
  const Running running(scheduler);
  source.out.Publish(1);
  MustSucceed(Port::Connect(source.out, sink.in));
  WaitUntil("the value of the new connection sets the module off", [&] { return *runs > 0; });
}

TEST_F(TriggeredByAChange, AModuleThatIsConnectedToAQueueFindsTheDataThatIsThere) {
  const auto runs = std::make_shared<std::atomic<int>>(0);
  auto& sink = MakeSink(runs);
  MustSucceed(runtime.MakeReady(sink));
  const Running running(scheduler);
  source.out.Publish(1);
  MustSucceed(Port::Connect(source.out, sink.in, {.queue = 4}));
  WaitUntil("the value of the new connection sets the module off", [&] { return *runs > 0; });
}

TEST_F(TriggeredByAChange, AModuleThatTakesOverTheConnectionsOfAnotherIsSetOff) {
  const auto runs = std::make_shared<std::atomic<int>>(0);
  auto& before = runtime.Create<Doing>(runtime.root(), "before");
  MustSucceed(runtime.MakeReady(before));
  auto& sink = MakeSink(runs);
  MustSucceed(runtime.MakeReady(sink));
  MustSucceed(Port::Connect(source.out, before.in));
  source.out.Publish(1);
  const Running running(scheduler);
  {
    auto hold = scheduler.HoldCycles({"/before", "/sink"}, 30s);
    ASSERT_TRUE(hold);
    sink.in.TakeOver(before.in);
  }
  WaitUntil("the value that has been taken over sets the module off", [&] { return *runs > 0; });
}

TEST_F(TriggeredByAChange, AModuleThatIsAddedDuringACycleIsNotForgottenAtTheEndOfThat) {
  std::atomic<bool> is_inside{false};
  std::atomic<bool> may_end{false};
  auto& feeder = runtime.Create<testing::Feeder>(runtime.root(), "feeder");
  auto& slow = runtime.Create<Doing>(runtime.root(), "slow");
  slow.action = [&](Doing&) {
    is_inside = true;
    WaitUntil("the cycle may end", [&] { return may_end.load(); });
  };
  MustSucceed(Port::Connect(feeder.out, slow.in));
  MustSucceed(runtime.MakeReady(slow));
  const Running running(scheduler);
  source.out.Publish(1);
  feeder.out.Publish(1);
  WaitUntil("the thread is in a cycle", [&] { return is_inside.load(); });
  const auto runs = std::make_shared<std::atomic<int>>(0);
  auto& sink = MakeSink(runs);
  MustSucceed(Port::Connect(source.out, sink.in));
  MustSucceed(runtime.MakeReady(sink));
  may_end = true;
  WaitUntil("the value that was there sets the added module off", [&] { return *runs > 0; });
}

}  // namespace
}  // namespace runnel

// Services and clients in threads that run when something comes.

#include <future>

#include "tests/plugins/services/service_fixture.h"

namespace runnel::test {
namespace {

constexpr ThreadOptions kTriggered{.activation = ThreadOptions::Activation::kTrigger};

/// Serves by a thread of its own, when it is let go.
class SlowServer final : public Module {
 public:
  using Module::Module;
  Service<int(int)> twice{this, "twice", &SlowServer::Twice};
  static inline std::atomic<int> begun{0};
  static inline std::atomic<bool> may_end{false};

 private:
  Result<int> Twice(Activity& activity, int value) {
    ++begun;
    while (!may_end && !activity.is_abort_asked()) std::this_thread::yield();
    return 2 * value;
  }
  void Update() override {}
};

class TriggeredServiceTest : public RealEditorTest {
 protected:
  TriggeredServiceTest() {
    Register<Server>("test/server");
    Register<TripleServer>("test/triple_server");
    Register<SlowServer>("test/slow_server");
    Register<Asker>("test/asker");
    SlowServer::begun = 0;
    SlowServer::may_end = false;
    Must({AddThread{"serving", kTriggered}, AddThread{"asking", kTriggered}});
  }
  /// A server in `thread`, and a client that asks it.
  void Serve(const std::string& type, const std::string& thread) {
    Must({CreateModule{"/app/server", type}, CreateModule{"/app/asker", "test/asker"},
          AssignToThread{"/app/server", thread}, AssignToThread{"/app/asker", "asking"},
          ConnectPorts{"/app/server/twice", "/app/asker/twice"}});
  }
  Client<int(int)>& twice() { return At<Asker>("/app/asker").twice; }
  int Answer(CallFuture<int(int)>& future) {
    WaitUntil("it is answered", [&] { return future.is_done(); });
    return future.outcome() ? *future.outcome() : -1;
  }
};

TEST_F(TriggeredServiceTest, ACallSetsTheServerOff) {
  Serve("test/server", "serving");
  ASSERT_TRUE(scheduler.Start());
  auto future = twice().Begin(21);
  EXPECT_EQ(Answer(future), 42);
  ASSERT_EQ(twice().Send(1), CallStatus::kPending);
  WaitUntil("it is served", [&] { return At<Server>("/app/server").twice.state().answered == 2; });
}

TEST_F(TriggeredServiceTest, AnAnswerSetsTheCallerOff) {
  Serve("test/server", "fast");
  std::promise<int> told;
  ASSERT_EQ(twice().Call([&](const CallOutcome<int>& outcome) { told.set_value(*outcome); }, 4), CallStatus::kPending);
  ASSERT_TRUE(scheduler.Start());
  EXPECT_EQ(told.get_future().get(), 8);
}

TEST_F(TriggeredServiceTest, WhatWaitsWhenTheServerComesToTriggersIsServed) {
  Serve("test/server", "slow");
  auto future = twice().Begin(3);
  Must({AssignToThread{"/app/server", "serving"}});
  ASSERT_TRUE(scheduler.Start());
  EXPECT_EQ(Answer(future), 6);
}

TEST_F(TriggeredServiceTest, WhoTakesTheServersPlaceIsSetOffToo) {
  Serve("test/server", "serving");
  ASSERT_TRUE(scheduler.Start());
  Must({ReplaceModule{"/app/server", "test/triple_server"}});
  auto future = twice().Begin(3);
  EXPECT_EQ(Answer(future), 9);
}

TEST_F(TriggeredServiceTest, TheNextLongCallBeginsWhenTheOneBeforeIsOver) {
  Serve("test/slow_server", "serving");
  ASSERT_TRUE(scheduler.Start());
  auto first = twice().Begin(1);
  WaitUntil("the first has begun", [] { return SlowServer::begun == 1; });
  auto second = twice().Begin(2);
  SlowServer::may_end = true;
  EXPECT_EQ(Answer(first), 2);
  EXPECT_EQ(Answer(second), 4);
}

}  // namespace
}  // namespace runnel::test

// Calls that take long: a thread of the service's own, progress, abort.

#include <thread>

#include "tests/plugins/services/service_fixture.h"

namespace runnel::test {
namespace {

/// Works until it is let go or told to end.
class Worker final : public Module {
 public:
  Service<int(int)> work{this, "work", &Worker::Work, {.queue = 4}};
  static inline std::atomic<bool> may_end{false};
  static inline std::atomic<int> begun{0};
  static inline std::atomic<bool> takes_lock{false};
  static inline std::atomic<bool> is_deaf{false};
  static inline std::atomic<int> alive{0};
  explicit Worker(const Placement& placement) : Module(placement) { ++alive; }
  ~Worker() override { --alive; }

 private:
  Result<int> Work(Activity& activity, int value) {
    ++begun;
    activity.Report(0.5, "waiting");
    while (!may_end) {
      if (takes_lock) const std::lock_guard lock(runtime().structure_mutex());
      if (activity.is_abort_asked() && !is_deaf) return Error{.message = "stopped halfway"};
      std::this_thread::yield();
    }
    if (value < 0) throw std::runtime_error("is negative");
    return value + 1;
  }
  void Update() override {}
};

class ActivityTest : public EditorTest {
 protected:
  ActivityTest() {
    Worker::may_end = false;
    Worker::begun = 0;
    Worker::is_deaf = false;
    Register<Worker>("test/worker");
    Must({CreateModule{"/app/worker", "test/worker"}});
    client = std::make_unique<Client<int(int)>>(At<Group>("/app"), "client", ClientOptions{.timeout = 1h});
    EXPECT_TRUE(Port::Connect(worker().work.port(), client->port()));
  }
  Worker& worker() { return At<Worker>("/app/worker"); }
  void WaitUntilBegun(int count = 1) {
    WaitUntil("the handler runs", [&] { return Worker::begun >= count; });
  }
  std::unique_ptr<Client<int(int)>> client;
};

TEST_F(ActivityTest, RunsBesideTheCyclesAndReportsProgress) {
  auto future = client->Begin(1);
  Steps(1);
  WaitUntil("progress is there", [&] { return future.progress() == 0.5; });
  Steps(5);
  EXPECT_FALSE(future.is_done());
  const auto state = worker().work.state();
  ASSERT_EQ(state.running.size(), 1u);
  EXPECT_EQ(state.running[0].doing, "waiting");
  Worker::may_end = true;
  EXPECT_EQ(*future.Wait(), 2);
}

TEST_F(ActivityTest, OneCallAtATime) {
  auto first = client->Begin(1);
  auto second = client->Begin(2);
  Steps(3);
  WaitUntilBegun();
  EXPECT_EQ(worker().work.state().waiting, 1u);
  Worker::may_end = true;
  EXPECT_EQ(*first.Wait(), 2);
  WaitUntil("the second has been served", [&] {
    Steps(1);
    return second.is_done();
  });
  EXPECT_EQ(*second.outcome(), 3);
}

TEST_F(ActivityTest, TheCallerAborts) {
  auto future = client->Begin(1);
  Steps(1);
  WaitUntilBegun();
  future.Abort();
  const auto outcome = future.Wait();
  EXPECT_EQ(outcome.status(), CallStatus::kAborted);
  EXPECT_THAT(std::string(outcome.error()), HasSubstr("stopped halfway"));
}

TEST_F(ActivityTest, SomebodyElseAborts) {
  EXPECT_FALSE(worker().work.Abort()) << "nothing is under way";
  auto future = client->Begin(1);
  Steps(1);
  WaitUntilBegun();
  EXPECT_TRUE(worker().work.Abort());
  EXPECT_EQ(future.Wait().status(), CallStatus::kAborted);
}

TEST_F(ActivityTest, WhatItThrowsEndsTheCallAndNotTheModule) {
  Worker::may_end = true;
  auto future = client->Begin(-1);
  Steps(1);
  EXPECT_EQ(future.Wait().status(), CallStatus::kFailed);
  EXPECT_EQ(future.outcome().error(), "is negative");
  auto next = client->Begin(1);
  WaitUntil("the worker is free", [&] {
    Steps(1);
    return next.is_done();
  });
  EXPECT_TRUE(next.outcome());
}

TEST_F(ActivityTest, ASwapLosesNeitherTheCallThatRunsNorThoseThatWait) {
  auto first = client->Begin(1);
  auto second = client->Begin(2);
  Steps(1);
  WaitUntilBegun();
  Must({ReplaceModule{"/app/worker", "test/worker"}});
  EXPECT_FALSE(first.is_done()) << "by the old module's thread, until that module goes";
  Steps(1);
  WaitUntilBegun(2);
  Worker::may_end = true;
  EXPECT_EQ(*first.Wait(), 2);
  EXPECT_EQ(*second.Wait(), 3);
}

// A handler that wants the structure lock, when its module is deleted by who has it, is waited for without it.
TEST_F(ActivityTest, AHandlerMayTakeTheStructureLockWhileItsModuleIsDeleted) {
  Worker::takes_lock = true;
  auto call = client->Begin(1);
  Steps(1);
  WaitUntilBegun();
  Must({DeleteElement{"/app/worker"}});
  Worker::takes_lock = false;
  EXPECT_TRUE(call.is_done());
}

// Neither who deletes a module, nor who replaces it, waits for ever for a handler that does not hear that it should end.
TEST_F(ActivityTest, ADeafHandlerKeepsNobodyWaiting) {
  Worker::is_deaf = true;
  Worker::alive = 1;
  auto replaced = client->Begin(1);
  Steps(1);
  WaitUntilBegun();
  Must({ReplaceModule{"/app/worker", "test/worker", {}, 0}});
  EXPECT_EQ(Worker::alive, 2) << "the old one, too, as its handler uses it";
  auto deleted = client->Begin(2);
  Steps(1);
  WaitUntilBegun(2);
  const ChangeOutcome outcome = editor.Apply({DeleteElement{"/app/worker"}});
  ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
  EXPECT_THAT(outcome.diagnostics.ToString(), HasSubstr("/app/worker: is deleted; a call of its service"));
  EXPECT_FALSE(Exists("/app/worker"));
  EXPECT_EQ(deleted.outcome().status(), CallStatus::kDisconnected);
  EXPECT_EQ(Worker::alive, 2);
  Worker::may_end = true;
  WaitUntil("both are destroyed, by whoever changes something next", [&] {
    Must({CreateGroup{"/app/group"}, DeleteElement{"/app/group"}});
    return Worker::alive == 0;
  });
}

TEST_F(ActivityTest, DeletingTheModuleEndsItsCalls) {
  auto first = client->Begin(1);
  auto second = client->Begin(2);
  Steps(1);
  WaitUntilBegun();
  Must({DeleteElement{"/app/worker"}});
  EXPECT_TRUE(first.is_done());
  EXPECT_EQ(second.outcome().status(), CallStatus::kDisconnected);
}

}  // namespace
}  // namespace runnel::test

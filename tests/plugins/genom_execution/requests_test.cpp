#include <atomic>
#include <memory>
#include <thread>

#include <gtest/gtest.h>

#include "tests/plugins/genom_execution/sketch.h"

namespace runnel::genom_execution {
namespace {

using namespace std::chrono_literals;

TEST(Requests, RunValidationThenCodelsInOrder) {
  Sketch sketch;
  sketch.AddTask({.name = "main"});
  sketch.AddService({.name = "f", .validates = {"check", "check2"}, .codels = {"one", "two"}});
  sketch.Start();
  sketch.RunAt(0ms);
  Request& f = sketch.Send("f");
  sketch.RunAt(1ms);
  EXPECT_EQ(sketch.Trace(), "check check2 one two");
  EXPECT_TRUE(f.state() == Request::State::kDone && f.outcome().is_success());
}

TEST(Requests, EndWithTheFirstException) {
  Sketch sketch;
  sketch.AddTask({.name = "main"});
  sketch.AddService({.name = "f", .validates = {"check"}, .codels = {"one", "two"}, .throws = {"wrong"}});
  bool is_wrong = true;
  sketch.Do("check", [&](const Invocation& call) -> Event {
    return is_wrong ? call.context->raise(sketch.Of("wrong"), nullptr, 0, call.context) : nullptr;
  });
  sketch.Do("one", [&](const Invocation&) { return sketch.Of("strange"); });
  sketch.Start();
  sketch.RunAt(0ms);
  Request& refused = sketch.Send("f");
  sketch.RunAt(1ms);
  EXPECT_EQ(sketch.Trace(), "check");
  EXPECT_EQ(sketch.TextOf(refused), "wrong");
  is_wrong = false;
  Request& failed = sketch.Send("f");
  sketch.RunAt(2ms);
  EXPECT_EQ(sketch.Trace(), "check one");
  EXPECT_EQ(failed.outcome().exception(), kUnknownException) << "one that is not declared";
}

TEST(Requests, OfAttributesWriteAndReadTheIds) {
  Sketch sketch;
  sketch.AddTask({.name = "main"});
  sketch.AddService(
      {.name = "set", .kind = ServiceKind::kAttribute, .validates = {"check"}, .assign = [](void* ids, void* data) {
         *static_cast<int*>(ids) = *static_cast<int*>(data);
       }});
  sketch.AddService({.name = "get", .kind = ServiceKind::kAttribute, .assign = [](void* ids, void* data) {
                       *static_cast<int*>(data) = *static_cast<int*>(ids);
                     }});
  int ids = 1;
  sketch.Do("check",
            [&](const Invocation& call) { return *static_cast<int*>(call.data) < 10 ? nullptr : kDisallowed; });
  sketch.Start({.ids = &ids});
  sketch.RunAt(0ms);
  Request& set = sketch.Send("set");
  *static_cast<int*>(set.data()) = 5;
  sketch.RunAt(1ms);
  EXPECT_EQ(ids, 5);
  *static_cast<int*>(set.data()) = 50;
  ASSERT_TRUE(sketch.engine().Send(set));
  sketch.RunAt(2ms);
  EXPECT_EQ(ids, 5) << "what is refused changes nothing";
  Request& get = sketch.Send("get");
  sketch.RunAt(3ms);
  EXPECT_EQ(*static_cast<int*>(get.data()), 5);
}

TEST(Requests, AfterAndBeforeOthers) {
  Sketch sketch;
  sketch.AddTask({.name = "main"});
  sketch.AddService({.name = "init", .codels = {"i"}, .before = {"go"}});
  sketch.AddService({.name = "go", .codels = {"g"}, .after = {"init"}});
  sketch.Start();
  sketch.RunAt(0ms);
  Request& too_early = sketch.Send("go");
  Request& init = sketch.Send("init");
  Request& go = sketch.Send("go");
  Request& too_late = sketch.Send("init");
  sketch.RunAt(1ms);
  EXPECT_EQ(sketch.Trace(), "i g");
  EXPECT_EQ(too_early.outcome().exception(), kDisallowed);
  EXPECT_TRUE(init.outcome().is_success() && go.outcome().is_success());
  EXPECT_EQ(too_late.outcome().exception(), kDisallowed);
}

TEST(Requests, AreRefusedWhereNoActivityHasRoom) {
  Sketch sketch;
  sketch.AddTask({.name = "main"});
  sketch.AddService({"go", ServiceKind::kActivity, "main", {{"start", "s", {"pause::start"}}}});
  sketch.Start({.activities = 2});
  sketch.RunAt(0ms);
  Request& first = sketch.Send("go");
  Request& second = sketch.Send("go");
  Request& third = sketch.Send("go");
  sketch.RunAt(1ms);
  EXPECT_NE(first.id(), second.id());
  EXPECT_EQ(third.outcome().exception(), kTooManyActivities);
  Request& abort = sketch.Send("abort_activity");
  abort.abort_id = first.id();
  ASSERT_TRUE(sketch.engine().Send(abort));
  sketch.RunAt(2ms);
  EXPECT_EQ(sketch.TextOf(first), "interrupted {by: abort_activity}");
  Request& again = sketch.Send("go");
  sketch.RunAt(3ms);
  EXPECT_EQ(again.state(), Request::State::kAccepted);
  abort.abort_id = 99;
  ASSERT_TRUE(sketch.engine().Send(abort));
  sketch.RunAt(4ms);
  EXPECT_EQ(abort.outcome().exception(), kNoSuchActivity);
}

TEST(Requests, TellTheirSenderOfChanges) {
  Sketch sketch;
  sketch.AddTask({.name = "main"});
  sketch.AddService({"go", ServiceKind::kActivity, "main", {{"start", "s", {"ether"}}}});
  sketch.Start();
  sketch.RunAt(0ms);
  Request& go = sketch.Send("go");
  struct Sender {
    Sketch& sketch;
    Request& request;
  } sender{sketch, go};
  go.client = &sender;
  go.on_change = [](void* client) {
    const auto& [to, request] = *static_cast<Sender*>(client);
    to.Note(request.state() == Request::State::kAccepted ? "accepted" : "done");
  };
  sketch.RunAt(1ms);
  EXPECT_EQ(sketch.Trace(), "accepted s done");
}

// Seen by ThreadSanitizer; and by AddressSanitizer, if the other thread comes in between.
TEST(Requests, MayBeDestroyedAsSoonAsTheyAreDone) {
  Sketch sketch;
  sketch.AddTask({.name = "main"});
  sketch.AddService({.name = "f", .codels = {"one"}});
  Engine& engine = sketch.Start();
  const ServiceTable& service = sketch.Send("f").service();
  sketch.RunAt(0ms);
  for (int i = 0; i < 100; ++i) {
    std::atomic<int> told{0};
    auto request = std::make_unique<Request>(engine.component(), service);
    request->client = &told;
    request->on_change = [](void* client) { ++*static_cast<std::atomic<int>*>(client); };
    ASSERT_TRUE(engine.Send(*request));
    std::thread maker([&request] {
      while (request->state() != Request::State::kDone) std::this_thread::yield();
      request.reset();
    });
    sketch.RunAt(1ms);
    maker.join();
    EXPECT_EQ(told, 1);
  }
}

TEST(Requests, AreRefusedWhenTooManyWait) {
  Sketch sketch;
  sketch.AddTask({.name = "main"});
  sketch.AddService({.name = "f", .codels = {"one"}});
  sketch.Start({.requests = 1});
  Request& first = sketch.Send("f");
  Request& second = sketch.Send("f");
  EXPECT_EQ(second.state(), Request::State::kIdle);
  sketch.RunAt(0ms);
  EXPECT_EQ(first.state(), Request::State::kDone);
}

}  // namespace
}  // namespace runnel::genom_execution

#include <gtest/gtest.h>

#include "plugins/testing/guards.h"
#include "tests/plugins/genom_execution/sketch.h"

namespace runnel::genom_execution {
namespace {

using namespace std::chrono_literals;

TEST(Passes, RunOneCodelOfEachActivityInTheOrderOfTheirSlots) {
  Sketch sketch;
  sketch.AddTask({.name = "main", .states = {{"start", "init", {"pause::start"}}}});
  sketch.AddService({"a", ServiceKind::kActivity, "main", {{"start", "a1", {"next"}}, {"next", "a2", {"ether"}}}});
  sketch.AddService({"b", ServiceKind::kActivity, "main", {{"start", "b1", {"next"}}, {"next", "b2", {"ether"}}}});
  sketch.Start();
  sketch.RunAt(0ms);
  EXPECT_EQ(sketch.Trace(), "init");
  Request& a = sketch.Send("a");
  Request& b = sketch.Send("b");
  // What happens wakes the permanent activity, too: each step, each end, each request.
  EXPECT_EQ(sketch.engine().RunControl(), Pass::kIdle);
  EXPECT_EQ(sketch.engine().RunTask(0, Time()), Pass::kAgain);
  EXPECT_EQ(sketch.Trace(), "init a1 b1");
  EXPECT_EQ(sketch.engine().RunTask(0, Time()), Pass::kIdle);
  EXPECT_EQ(sketch.Trace(), "init a2 b2");
  EXPECT_EQ(a.state(), Request::State::kAccepted);
  (void)sketch.engine().RunControl();
  EXPECT_EQ(a.state(), Request::State::kDone);
  EXPECT_EQ(b.state(), Request::State::kDone);
}

TEST(Passes, OfAPeriodicTaskPauseUntilItsNextTick) {
  Sketch sketch;
  sketch.AddTask(
      {.name = "drive",
       .period = 20ms,
       .delay = 5ms,
       .states = {{"start", "init", {"loop"}}, {"loop", "loop1", {"second"}}, {"second", "loop2", {"pause::loop"}}}});
  sketch.Start();
  sketch.RunAt(100ms);
  EXPECT_EQ(sketch.Trace(), "") << "the first tick is as late as the delay says";
  sketch.RunAt(105ms);
  EXPECT_EQ(sketch.Trace(), "init loop1 loop2");
  for (auto time = 106ms; time < 125ms; ++time) sketch.RunAt(time);
  EXPECT_EQ(sketch.Trace(), "");
  sketch.RunAt(125ms);
  EXPECT_EQ(sketch.Trace(), "loop1 loop2");
  sketch.RunAt(190ms);
  EXPECT_EQ(sketch.Trace(), "loop1 loop2") << "ticks that nobody has run are gone";
  sketch.RunAt(204ms);
  EXPECT_EQ(sketch.Trace(), "");
  sketch.RunAt(205ms);
  EXPECT_EQ(sketch.Trace(), "loop1 loop2");
}

TEST(Passes, OfAPeriodicTaskBeginAnewWhenTheClockIsSetBack) {
  Sketch sketch;
  sketch.AddTask({.name = "drive", .period = 20ms, .delay = 5ms, .states = {{"start", "init", {"pause::start"}}}});
  sketch.Start();
  sketch.RunAt(1000s);
  sketch.RunAt(1000s + 5ms);
  EXPECT_EQ(sketch.Trace(), "init");
  sketch.RunAt(10s);
  EXPECT_EQ(sketch.Trace(), "") << "the first tick is as late as the delay says";
  sketch.RunAt(10s + 5ms);
  EXPECT_EQ(sketch.Trace(), "init");
  sketch.RunAt(10s + 25ms);
  EXPECT_EQ(sketch.Trace(), "init");
}

TEST(Passes, OfAPeriodicTaskSeeStartAndStopOnATickOnly) {
  Sketch sketch;
  sketch.AddTask({.name = "drive", .period = 20ms});
  sketch.AddService(
      {"go", ServiceKind::kActivity, "drive", {{"start", "begin", {"pause::start"}}, {"stop", "end", {"ether"}}}});
  sketch.Start();
  sketch.RunAt(0ms);
  Request& go = sketch.Send("go");
  sketch.RunAt(10ms);
  EXPECT_EQ(sketch.Trace(), "");
  sketch.RunAt(20ms);
  EXPECT_EQ(sketch.Trace(), "begin");
  Request& abort = sketch.Send("abort_activity");
  abort.abort_id = go.id();
  ASSERT_TRUE(sketch.engine().Send(abort));
  sketch.RunAt(30ms);
  EXPECT_EQ(sketch.Trace(), "");
  EXPECT_TRUE(abort.state() == Request::State::kDone && abort.outcome().is_success())
      << "does not wait for what it ends";
  sketch.RunAt(40ms);
  EXPECT_EQ(sketch.Trace(), "end");
  EXPECT_EQ(go.state(), Request::State::kDone);
  EXPECT_TRUE(go.outcome().is_success()) << "a path from stop to ether is a success";
}

TEST(Passes, OfAnAperiodicTaskPauseUntilSomethingHappens) {
  Sketch sketch;
  sketch.AddTask({.name = "poll", .states = {{"start", "poll", {"pause::start"}}}});
  sketch.AddTask({.name = "drive", .period = 10ms, .states = {{"start", "step", {"pause::start"}}}});
  sketch.AddService({.name = "ask", .codels = {"answer"}});
  sketch.Start();
  sketch.RunAt(0ms);
  (void)sketch.Trace();
  sketch.RunAt(10ms);
  EXPECT_EQ(sketch.Trace(), "step") << "a pause is nothing that happens";
  (void)sketch.Send("ask");
  sketch.RunAt(12ms);
  EXPECT_EQ(sketch.Trace(), "answer poll");
}

TEST(Passes, EndActivitiesThatReturnWhatIsNotTheirs) {
  Sketch sketch;
  sketch.AddTask({.name = "main"});
  sketch.AddService({"go", ServiceKind::kActivity, "main", {{"start", "begin", {"ether"}}}});
  sketch.Do("begin", [&](const Invocation&) { return sketch.Of("elsewhere"); });
  sketch.Start();
  sketch.RunAt(0ms);
  Request& go = sketch.Send("go");
  sketch.RunAt(1ms);
  EXPECT_EQ(go.outcome().exception(), kBadTransition);
  EXPECT_EQ(sketch.TextOf(go), "bad_transition {from: start, to: elsewhere}");
}

TEST(Passes, EndActivitiesByExceptionsWithTheirDetails) {
  Sketch sketch;
  sketch.AddTask({.name = "main"});
  sketch.AddService({.name = "go",
                     .kind = ServiceKind::kActivity,
                     .task = "main",
                     .states = {{"start", "begin", {"ether"}}},
                     .throws = {"bad_speed"}});
  sketch.Do("begin", [&](const Invocation& call) {
    const int limit = 7;
    return call.context->raise(sketch.Of("bad_speed"), &limit, sizeof limit, call.context);
  });
  sketch.Start();
  sketch.RunAt(0ms);
  Request& go = sketch.Send("go");
  sketch.RunAt(1ms);
  EXPECT_EQ(go.outcome().exception(), sketch.Of("bad_speed"));
  EXPECT_EQ(sketch.TextOf(go), "bad_speed {limit: 7}");
}

TEST(Passes, AllocateNothing) {
  Sketch sketch;
  sketch.AddTask({.name = "drive", .period = 10ms, .states = {{"start", "step", {"pause::start"}}}});
  sketch.AddService({"go", ServiceKind::kActivity, "drive", {{"start", "s", {"ether"}}}, {}, {}, {}, {"go"}});
  sketch.Do("step", [&](const Invocation&) { return sketch.Of("pause::start"); });
  sketch.Do("s", [&](const Invocation&) { return sketch.Of("ether"); });
  sketch.Exclude("step", "go");
  sketch.Start();
  sketch.RunAt(0ms);
  Request& go = sketch.Send("go");
  sketch.RunAt(10ms);
  sketch.is_quiet = true;
  ASSERT_EQ(go.state(), Request::State::kDone);
  const test::AllocationGuard guard;
  ASSERT_TRUE(sketch.engine().Send(go));
  for (int i = 20; i <= 40; i += 10) {
    (void)sketch.engine().RunControl();
    (void)sketch.engine().RunTask(0, Time(milliseconds(i)));
  }
  EXPECT_EQ(go.state(), Request::State::kDone);
  EXPECT_EQ(guard.allocations(), 0u);
}

}  // namespace
}  // namespace runnel::genom_execution

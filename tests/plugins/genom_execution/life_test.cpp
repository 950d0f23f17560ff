#include <gtest/gtest.h>

#include "tests/plugins/genom_execution/sketch.h"

namespace runnel::genom_execution {
namespace {

using namespace std::chrono_literals;

TEST(Life, BeginsTaskByTaskAndThenServes) {
  Sketch sketch;
  sketch.AddTask({.name = "slow", .period = 20ms, .delay = 10ms, .states = {{"start", "init", {"pause::start"}}}});
  sketch.AddTask({.name = "other", .states = {{"start", "second", {"ether"}}}});
  sketch.AddService({.name = "f", .codels = {"one"}});
  sketch.Start();
  Request& early = sketch.Send("f");
  sketch.RunAt(0ms);
  EXPECT_EQ(sketch.Trace(), "");
  EXPECT_EQ(early.state(), Request::State::kSent);
  sketch.RunAt(10ms);
  EXPECT_EQ(sketch.Trace(), "init second one");
  EXPECT_EQ(early.state(), Request::State::kDone);
}

TEST(Life, EndsAtOnceIfATaskCannotBegin) {
  Sketch sketch;
  sketch.AddTask({.name = "first", .states = {{"start", "init", {"pause::start"}}, {"stop", "quiet", {"ether"}}}});
  sketch.AddTask({.name = "main", .states = {{"start", "fail", {"ether"}}}, .throws = {"no_device"}});
  sketch.AddTask({.name = "never", .states = {{"start", "init2", {"ether"}}}});
  sketch.Do("fail", [&](const Invocation&) { return sketch.Of("no_device"); });
  sketch.Start();
  sketch.RunAt(0ms);
  EXPECT_EQ(sketch.Trace(), "init fail quiet");
  EXPECT_TRUE(sketch.engine().is_ended());
  ASSERT_NE(sketch.engine().failure(), nullptr);
  EXPECT_EQ(sketch.engine().failure()->exception(), sketch.Of("no_device"));
}

TEST(Life, EndsActivitiesThenTasksInReverseOrder) {
  Sketch sketch;
  sketch.AddTask({.name = "first", .states = {{"start", "init1", {"pause::start"}}, {"stop", "stop1", {"ether"}}}});
  sketch.AddTask(
      {.name = "second",
       .period = 10ms,
       .states = {{"start", "init2", {"ether"}}, {"stop", "stop2", {"rest"}}, {"rest", "rest2", {"ether"}}}});
  sketch.AddTask({.name = "third", .states = {{"stop", "stop3", {"ether"}}}});
  sketch.AddTask({.name = "fourth", .states = {{"start", "init4", {"pause::start"}}}});
  sketch.AddService(
      {"go", ServiceKind::kActivity, "second", {{"start", "go1", {"pause::start"}}, {"stop", "halt", {"ether"}}}});
  sketch.Start();
  sketch.RunAt(0ms);
  Request& go = sketch.Send("go");
  sketch.RunAt(10ms);
  (void)sketch.Trace();
  Request& kill = sketch.Send("kill");
  sketch.RunAt(15ms);
  EXPECT_TRUE(kill.outcome().is_success());
  EXPECT_FALSE(sketch.engine().is_ended());
  Request& late = sketch.Send("go");
  (void)sketch.Trace();  // the permanent activities go on until it is their turn
  sketch.RunAt(20ms);
  EXPECT_TRUE(go.state() == Request::State::kDone && go.outcome().is_success());
  sketch.RunAt(30ms);
  EXPECT_TRUE(sketch.engine().is_ended());
  std::string trace = sketch.Trace();
  for (std::size_t at; (at = trace.find("init4 ")) != std::string::npos;) trace.erase(at, 6);
  for (std::size_t at; (at = trace.find("init1 ")) != std::string::npos;) trace.erase(at, 6);
  EXPECT_EQ(trace, "halt stop3 stop2 rest2 stop1");
  EXPECT_EQ(sketch.TextOf(late), "interrupted {by: kill}");
  Request& later = sketch.Send("go");
  sketch.RunAt(40ms);
  EXPECT_EQ(later.outcome().exception(), kInterrupted);
}

TEST(Life, ComesToAnEndWithoutTimePassing) {
  Sketch sketch;
  sketch.AddTask({.name = "main",
                  .period = 1000ms,
                  .states = {{"start", "init", {"pause::start"}}, {"stop", "quiet", {"ether"}}}});
  sketch.AddService(
      {"go", ServiceKind::kActivity, "main", {{"start", "go1", {"pause::start"}}, {"stop", "halt", {"ether"}}}});
  Engine& engine = sketch.Start();
  sketch.RunAt(0ms);
  (void)sketch.Send("go");
  sketch.RunAt(1000ms);
  (void)sketch.Trace();
  engine.Stop();
  for (int i = 0; i < 10 && !engine.is_ended(); ++i) {
    (void)engine.RunControl();
    (void)engine.RunTask(0, Time(1001ms), true);
  }
  EXPECT_EQ(sketch.Trace(), "init halt quiet");
  EXPECT_TRUE(engine.is_ended());
}

}  // namespace
}  // namespace runnel::genom_execution

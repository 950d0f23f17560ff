#include <gtest/gtest.h>

#include "tests/plugins/genom_execution/sketch.h"

namespace runnel::genom_execution {
namespace {

using namespace std::chrono_literals;

// `go` takes two steps to stop, `turn` interrupts it, `go` and itself.
class Interruption : public testing::Test {
 protected:
  void SetUp() override {
    sketch.AddTask({.name = "main", .period = 10ms});
    sketch.AddService(
        {"go",
         ServiceKind::kActivity,
         "main",
         {{"start", "go1", {"pause::start"}}, {"stop", "halt1", {"pause::rest"}}, {"rest", "halt2", {"ether"}}}});
    sketch.AddService({.name = "turn",
                       .kind = ServiceKind::kActivity,
                       .task = "main",
                       .states = {{"start", "turn1", {"pause::start"}}},
                       .interrupts = {"go", "turn"}});
    sketch.AddService({.name = "quiet", .codels = {"q"}, .interrupts = {"go", "turn"}});
    sketch.Start();
    sketch.RunAt(0ms);
  }
  Sketch sketch;
};

TEST_F(Interruption, LetsTheOtherEndFirst) {
  Request& go = sketch.Send("go");
  sketch.RunAt(10ms);
  Request& turn = sketch.Send("turn");
  sketch.RunAt(20ms);
  EXPECT_EQ(sketch.Trace(), "go1 halt1");
  EXPECT_EQ(turn.state(), Request::State::kAccepted);
  sketch.RunAt(30ms);
  EXPECT_EQ(sketch.Trace(), "halt2");
  EXPECT_TRUE(go.state() == Request::State::kDone && go.outcome().is_success());
  sketch.RunAt(40ms);
  EXPECT_EQ(sketch.Trace(), "turn1");
}

TEST_F(Interruption, EndsAtOnceWhatCannotStop) {
  Request& turn = sketch.Send("turn");
  sketch.RunAt(10ms);
  Request& quiet = sketch.Send("quiet");
  sketch.RunAt(20ms);
  EXPECT_EQ(sketch.Trace(), "turn1 q");
  EXPECT_TRUE(quiet.outcome().is_success());
  EXPECT_EQ(sketch.TextOf(turn), "interrupted {by: quiet}");
}

TEST_F(Interruption, OfOneThatNamesItselfReplacesIt) {
  Request& first = sketch.Send("turn");
  sketch.RunAt(10ms);
  Request& second = sketch.Send("turn");
  sketch.RunAt(20ms);
  EXPECT_EQ(first.state(), Request::State::kDone);
  sketch.RunAt(30ms);
  EXPECT_EQ(second.state(), Request::State::kAccepted);
  EXPECT_EQ(sketch.Trace(), "turn1 turn1");
}

TEST_F(Interruption, EndsWhatWaitsAtOnce) {
  Request& go = sketch.Send("go");
  sketch.RunAt(10ms);
  Request& waiting = sketch.Send("turn");
  Request& next = sketch.Send("turn");
  sketch.RunAt(12ms);
  EXPECT_EQ(waiting.state(), Request::State::kDone);
  EXPECT_EQ(sketch.TextOf(waiting), "interrupted {by: turn}");
  EXPECT_EQ(go.state(), Request::State::kAccepted);
  for (auto time = 20ms; time <= 40ms; time += 10ms) sketch.RunAt(time);
  EXPECT_EQ(sketch.Trace(), "go1 halt1 halt2 turn1");
  EXPECT_EQ(next.state(), Request::State::kAccepted);
}

TEST_F(Interruption, OfOneThatHasNotStartedEndsIt) {
  sketch.RunAt(10ms);
  Request& go = sketch.Send("go");
  sketch.RunAt(11ms);  // is to start at the next tick
  (void)sketch.Send("quiet");
  sketch.RunAt(12ms);
  sketch.RunAt(20ms);
  EXPECT_EQ(sketch.Trace(), "q");
  EXPECT_EQ(sketch.TextOf(go), "interrupted {by: quiet}");
}

TEST_F(Interruption, IsSeenOnce) {
  Request& go = sketch.Send("go");
  sketch.RunAt(10ms);
  (void)sketch.Send("quiet");
  sketch.RunAt(20ms);
  (void)sketch.Send("quiet");
  sketch.RunAt(30ms);
  EXPECT_EQ(sketch.Trace(), "go1 q halt1 q halt2");
  EXPECT_EQ(go.state(), Request::State::kDone);
}

TEST_F(Interruption, LeavesWhatDoesNotNameItselfToRunInParallel) {
  Request& first = sketch.Send("go");
  Request& second = sketch.Send("go");
  sketch.RunAt(10ms);
  EXPECT_EQ(sketch.Trace(), "go1 go1");
  EXPECT_TRUE(first.state() == Request::State::kAccepted && second.state() == Request::State::kAccepted);
  EXPECT_STREQ(first.doing(), "start");
}

}  // namespace
}  // namespace runnel::genom_execution

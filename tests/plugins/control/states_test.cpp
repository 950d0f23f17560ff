// What people read of an application that somebody has stopped, paused, set by hand, or asked too much of.

#include <atomic>

#include "core/port/port.h"
#include "tests/plugins/control/control_fixture.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

using ::testing::AllOf;
using ::testing::Not;

/// Needs more time than its thread has.
class Slow final : public Module {
 public:
  using Module::Module;

 private:
  void Update() override { std::this_thread::sleep_for(5ms); }
};

/// Does not return from its cycle as long as somebody wants that.
class Hanging final : public Module {
 public:
  using Module::Module;
  static inline std::atomic<bool> hangs{false};

 private:
  void Update() override {
    while (hangs.load()) std::this_thread::sleep_for(1ms);
  }
};

class StatesTest : public ControlTest {
 protected:
  std::string State() { return Client().hello().state; }
  Port& PortAt(const std::string& path) { return dynamic_cast<Port&>(**runtime.root().Find(path)); }
};

TEST_F(StatesTest, NothingButRunningIsSaidOfOneThatRuns) { EXPECT_EQ(State(), "running"); }

TEST_F(StatesTest, TheStopOfTheRobotIsToldWithWhoPressedIt) {
  {
    const std::lock_guard lock(runtime.structure_mutex());
    EXPECT_TRUE(PortAt("/app/b/input/in").SetDriving(true, AnyValue(0), {}, DrivingKind::kEffort));
  }
  EXPECT_THAT(Ask("ls /b").output, AllOf(HasSubstr(", driving"), Not(HasSubstr("STOP"))));
  runtime.robot_stop().Press("a terminal");
  EXPECT_THAT(State(), ::testing::MatchesRegex("running, STOP in force for [0-9]+ s, by a terminal"));
  EXPECT_THAT(Ask("ls /b").output,
              AllOf(HasSubstr("by a terminal: all that drives has its safe value\n"), HasSubstr(", driving, IN STOP")));
  (void)runtime.robot_stop().Release("a terminal");
  EXPECT_EQ(State(), "running");
  EXPECT_THAT(Ask("ls /b").output, Not(HasSubstr("STOP")));
}

TEST_F(StatesTest, AStopThatStopsNothingIsToldAsThat) {
  const Told told = Ask("stop");
  EXPECT_EQ(told.code, 1);
  EXPECT_THAT(told.output, HasSubstr("STOP is in force"));
  EXPECT_THAT(told.errors, AllOf(HasSubstr("STOP stops nothing, and the robot may move"), HasSubstr("<driving port=")));
  EXPECT_THAT(State(), ::testing::EndsWith(", by a terminal, but NO PORT DRIVES"));
  EXPECT_EQ(Ask("release").code, 0);
}

TEST_F(StatesTest, WhoHasTheStructureIsTold) {
  const std::lock_guard lock(runtime.structure_mutex());
  EXPECT_THAT(State(), ::testing::StartsWith("running, BUSY changing its structure"));
}

TEST_F(StatesTest, WhatIsPausedByHandOrBlockedIsCounted) {
  ASSERT_TRUE(scheduler.SetPaused("/app/a", true));
  EXPECT_EQ(State(), "running, 1 module PAUSED");
  ASSERT_TRUE(scheduler.SetPaused("/app/a", false));
  ASSERT_EQ(Ask("publish /b/in 3").code, 0);
  EXPECT_EQ(State(), "running, 1 port set by hand");
  {
    const std::lock_guard lock(runtime.structure_mutex());
    ASSERT_TRUE(PortAt("/app/a/output/out").SetDriving(true, AnyValue(0), {}, DrivingKind::kEffort));
    ASSERT_TRUE(PortAt("/app/a/output/out").Block());
  }
  EXPECT_EQ(State(), "running, 1 port BLOCKED, 1 port set by hand");
  EXPECT_THAT(Ask("ls").output, AllOf(HasSubstr(", BLOCKED"), HasSubstr(", set by hand = 3")));
}

// Neither the structure lock nor the worker is waited for.
TEST_F(StatesTest, StopIsPressedWhoeverHasTheStructureAndTheWorker) {
  TaskGroup tasks(service->worker());
  std::atomic<bool> goes_on{false};
  tasks.Post([&] {
    while (!goes_on.load()) std::this_thread::sleep_for(1ms);
  });
  {
    const std::lock_guard lock(runtime.structure_mutex());
    const Told told = Ask("stop");
    EXPECT_EQ(told.code, 0) << told.errors;
    EXPECT_THAT(told.output, HasSubstr("STOP is in force"));
    EXPECT_TRUE(runtime.robot_stop().in_force());
    EXPECT_EQ(Ask("release").code, 0);
  }
  goes_on = true;
}

TEST_F(StatesTest, WhatDrivesIsNamed) {
  {
    const std::lock_guard lock(runtime.structure_mutex());
    EXPECT_TRUE(PortAt("/app/b/input/in").SetDriving(true, AnyValue(0), {}, DrivingKind::kEffort));
  }
  EXPECT_THAT(Ask("stop").output,
              HasSubstr("STOP is in force; 'runnel release' ends it; what drives: /app/b/input/in\n"));
  EXPECT_THAT(Ask("release").output,
              HasSubstr("released the STOP that a terminal had pressed; what drives: /app/b/input/in\n"));
  const Told again = Ask("release");
  EXPECT_EQ(again.code, 2);
  EXPECT_THAT(again.errors, HasSubstr("STOP is not in force"));
}

TEST_F(StatesTest, TheWordsOfBeforeAreRefusedWithThoseOfNow) {
  EXPECT_THAT(Ask("stop /app/a").errors, AllOf(HasSubstr("it is the STOP of the robot"), HasSubstr("'pause PATH'")));
  EXPECT_THAT(Ask("publish /b/in stop=yes").errors, HasSubstr("'block PORT'"));
  EXPECT_FALSE(runtime.robot_stop().in_force());
}

// Its request may have lain in the socket while this process stood still.
TEST_F(StatesTest, ATerminalIsHeardAsOfWhenItHasAsked) {
  OperatorWatch& operators = service->operators();
  operators.Begin(std::chrono::hours(1));
  const Time begun = operators.Look().value();
  const Time asked = begun - std::chrono::hours(1) + std::chrono::nanoseconds(1);
  EXPECT_EQ(State(), "running") << "who only looks who runs is not heard";
  const int client = RawClient();
  const auto ask = [&](const std::string& at) {
    SendAll(client, (at.empty() ? "" : FrameBytes("at", at)) + FrameBytes("request", "ls"));
    EXPECT_THAT(ReadAll(client, "end 1\n0\n"), HasSubstr("end 1\n0\n"));
    return operators.Look();
  };
  EXPECT_EQ(ask(""), begun);
  EXPECT_EQ(ask(std::to_string(asked.time_since_epoch().count())), asked + std::chrono::hours(1));
  for (const char* const no_time : {"1", "9223372036854775807"}) {
    SendAll(client, FrameBytes("at", no_time));
    EXPECT_EQ(ask(""), asked + std::chrono::hours(1)) << no_time;
  }
  close(client);
  for (const char* const no_time : {"", "soon"}) {
    const int other = RawClient();
    SendAll(other, FrameBytes("at", no_time));
    EXPECT_THAT(ReadAll(other, "in nanoseconds"), HasSubstr("a frame 'at' without a time in nanoseconds"));
    close(other);
  }
  EXPECT_EQ(Ask("ls").code, 0);
  EXPECT_GT(operators.Look(), asked + std::chrono::hours(1));
}

// It may have been kept up by another application that does not answer.
TEST_F(StatesTest, WhatWasAskedForBeforeTheLastPressNeitherReleasesNorMoves) {
  const auto ask = [&](Time asked, const std::string& request) {
    const int client = RawClient();
    SendAll(client,
            FrameBytes("at", std::to_string(asked.time_since_epoch().count())) + FrameBytes("request", request));
    const std::string answer = ReadAll(client, "end ");
    close(client);
    return answer;
  };
  runtime.robot_stop().Press("the test");
  const Time between = SteadyClock().Now();
  runtime.robot_stop().Press("the test, once more");
  EXPECT_THAT(ask(between, "release stop"), HasSubstr("STOP was pressed or released after this was asked for"));
  EXPECT_THAT(ask(between, "publish /b/in 1"), HasSubstr("STOP was pressed or released after this was asked for"));
  for (const char* const late : {"change\nconnect /a/out /b/in", "undo", "redo", "restart /app/a", "resume",
                                 "resume /app/a", "step 1", "speed 1", "call /a/out"}) {
    EXPECT_THAT(ask(between, late), HasSubstr("STOP was pressed or released after this was asked for")) << late;
  }
  EXPECT_THAT(ask(between, "change\nlog /app/a debug"), HasSubstr("/app/a: logs debug and more"))
      << "nothing moves by it";
  EXPECT_TRUE(runtime.robot_stop().in_force());
  EXPECT_THAT(ask(between, "stop"), testing::Not(HasSubstr("STOP was pressed after")));
  EXPECT_THAT(ask(SteadyClock().Now(), "release stop"), HasSubstr("released the STOP"));
  EXPECT_FALSE(runtime.robot_stop().in_force());
  runtime.robot_stop().Press("the test");
  const int says_no_time = RawClient();  // as an older one
  SendAll(says_no_time, FrameBytes("request", "release stop"));
  EXPECT_THAT(ReadAll(says_no_time, "end "), HasSubstr("released the STOP"));
  close(says_no_time);
}

TEST_F(StatesTest, QuitEndsTheRunAndNotTheRobot) {
  std::atomic<bool> has_quit{false};
  hooks.quit = [&]() -> Result<std::string> {
    has_quit = true;
    return std::string("the run ends");
  };
  StartServer({.application = "app", .folder = folder.path() / "runnel"});
  EXPECT_THAT(Ask("quit").output, HasSubstr("the run ends"));
  EXPECT_TRUE(has_quit);
  EXPECT_FALSE(runtime.robot_stop().in_force());
}

TEST_F(StatesTest, AModuleThatDoesNotReturnIsTold) {
  Register<Hanging>("test/hanging");
  ASSERT_EQ(Change("create thread other period=1ms\ncreate /hang test/hanging\nmove /hang to other").code, 0);
  ASSERT_TRUE(scheduler.SetStuckLimit("/app/hang", 20ms));
  Hanging::hangs = true;
  WaitUntil("it is told", [&] { return State().find("STUCK: /app/hang") != std::string::npos; });
  EXPECT_THAT(Ask("ls /hang").output, HasSubstr(", STUCK for "));
  Hanging::hangs = false;
  WaitUntil("it is well again", [&] { return State().find("STUCK") == std::string::npos; });
}

TEST_F(StatesTest, ADrivingPortThatNoStopReachesIsTold) {
  {
    const std::lock_guard lock(runtime.structure_mutex());
    EXPECT_TRUE(PortAt("/app/b/input/in").SetDriving(true, AnyValue(0), {}, DrivingKind::kEffort));
  }
  ASSERT_TRUE(scheduler.SetPaused("/app/b", true));
  EXPECT_EQ(State(), "running, 1 driving port CANNOT BE REACHED, 1 module PAUSED");
  EXPECT_THAT(Ask("ls /b").output, HasSubstr(", driving, CANNOT BE REACHED: /app/b is paused"));
}

TEST_F(StatesTest, AThreadThatOverrunsIsTold) {
  Register<Slow>("test/slow");
  ASSERT_EQ(Change("create thread busy period=1ms\ncreate /slow test/slow\nmove /slow to busy").code, 0);
  WaitUntil("overruns are told", [&] { return State().find("1 thread OVERRUNS") != std::string::npos; });
  EXPECT_THAT(Ask("ls /threads").output, HasSubstr(", OVERRUNS"));
}

}  // namespace
}  // namespace runnel::test

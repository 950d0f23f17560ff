// What people read of an application that somebody has stopped, paused, set by hand, or asked too much of.

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

class StatesTest : public ControlTest {
 protected:
  std::string State() { return Client().hello().state; }
  Port& PortAt(const std::string& path) { return dynamic_cast<Port&>(**runtime.root().Find(path)); }
};

TEST_F(StatesTest, NothingButRunningIsSaidOfOneThatRuns) { EXPECT_EQ(State(), "running"); }

TEST_F(StatesTest, TheStopOfTheRobotIsToldWithWhoPressedIt) {
  {
    const std::lock_guard lock(runtime.structure_mutex());
    EXPECT_TRUE(PortAt("/app/b/input/in").SetDriving(true, AnyValue(0)));
  }
  EXPECT_THAT(Ask("ls /b").output, AllOf(HasSubstr(", driving"), Not(HasSubstr("STOP"))));
  runtime.robot_stop().Press("a terminal");
  EXPECT_THAT(State(), ::testing::ContainsRegex("running, STOP in force for [0-9]+ s, by a terminal"));
  EXPECT_THAT(Ask("ls /b").output, AllOf(HasSubstr("by a terminal: all that drives has its safe value\n"),
                                         HasSubstr(", driving, IN STOP")));
  runtime.robot_stop().Release("a terminal");
  EXPECT_EQ(State(), "running");
  EXPECT_THAT(Ask("ls /b").output, Not(HasSubstr("STOP")));
}

TEST_F(StatesTest, WhatIsPausedByHandOrBlockedIsCounted) {
  ASSERT_TRUE(scheduler.SetPaused("/app/a", true));
  EXPECT_EQ(State(), "running, 1 module PAUSED");
  ASSERT_TRUE(scheduler.SetPaused("/app/a", false));
  ASSERT_EQ(Ask("publish /b/in 3").code, 0);
  EXPECT_EQ(State(), "running, 1 port set by hand");
  {
    const std::lock_guard lock(runtime.structure_mutex());
    ASSERT_TRUE(PortAt("/app/a/output/out").SetDriving(true, AnyValue(0)));
    ASSERT_TRUE(PortAt("/app/a/output/out").Block());
  }
  EXPECT_EQ(State(), "running, 1 port BLOCKED, 1 port set by hand");
  EXPECT_THAT(Ask("ls").output, AllOf(HasSubstr(", BLOCKED"), HasSubstr(", set by hand = 3")));
}

TEST_F(StatesTest, AThreadThatOverrunsIsTold) {
  Register<Slow>("test/slow");
  ASSERT_EQ(Change("create thread busy period=1ms\ncreate /slow test/slow\nmove /slow to busy").code, 0);
  WaitUntil("overruns are told", [&] { return State().find("1 thread OVERRUNS") != std::string::npos; });
  EXPECT_THAT(Ask("ls /threads").output, HasSubstr(", OVERRUNS"));
}

}  // namespace
}  // namespace runnel::test

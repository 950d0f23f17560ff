// A station that must be heard: the STOP of the robot is pressed when no operator is.

#include <gmock/gmock.h>

#include "core/element/runtime.h"
#include "plugins/command_service/command_service.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

class OperatorWatchTest : public ::testing::Test {
 protected:
  void Hear(const char* name) { watch.Hear(name, machine.Now()); }
  void After(Duration time) {
    machine.Advance(time);
    (void)watch.Look();
  }
  Runtime runtime;
  RobotStop& stop = runtime.robot_stop();
  ManualClock machine;
  OperatorWatch watch{stop, &machine};
};

TEST_F(OperatorWatchTest, PressesWhenNobodyHasBeenHeardForSoLongAndNamesTheLastOne) {
  watch.Begin(2s);
  Hear("viewer 1");
  After(1900ms);
  Hear("viewer 2");
  After(1999ms);
  EXPECT_FALSE(stop.in_force());
  EXPECT_EQ(watch.Look(), machine.Now() + 1ms);
  After(1ms);
  EXPECT_TRUE(stop.in_force());
  EXPECT_EQ(stop.state().by, "<operators>: none of them has been heard for 2s, the last one was viewer 2");
  EXPECT_EQ(watch.Look(), std::nullopt);
}

TEST_F(OperatorWatchTest, PressesWhenNoneHasComeSinceTheStart) {
  Hear("viewer 1");
  watch.Begin(2s);
  After(2s);
  EXPECT_EQ(stop.state().by, "<operators>: none of them has been heard for 2s, nor before");
}

TEST_F(OperatorWatchTest, AReleaseStaysOnlyWhereAnOperatorIsHeard) {
  watch.Begin(2s);
  After(2s);
  ASSERT_TRUE(stop.Release("a button"));
  (void)watch.Look();
  EXPECT_TRUE(stop.in_force()) << "nobody is heard";
  Hear("viewer 3");
  (void)watch.Look();
  EXPECT_TRUE(stop.in_force()) << "being heard releases nothing";
  ASSERT_TRUE(stop.Release("viewer 3"));
  After(1999ms);
  EXPECT_FALSE(stop.in_force());
  After(1ms);
  EXPECT_TRUE(stop.in_force());
}

TEST_F(OperatorWatchTest, WhatComesLateCountsAsOfWhenItWasSent) {
  watch.Begin(2s);
  machine.Advance(1500ms);
  watch.Hear("viewer 1", Time(1s));
  EXPECT_EQ(watch.Look(), Time(3s));
  for (const Time other : {Time(999ms), Time(1501ms), Time(1h), Time(), Time(-1h)}) watch.Hear("viewer 2", other);
  EXPECT_EQ(watch.Look(), Time(3s)) << "it is known already, or cannot be";
  After(1500ms);
  EXPECT_THAT(stop.state().by, HasSubstr("the last one was viewer 1"));
}

TEST_F(OperatorWatchTest, NobodyHasToBeHeardWhereTheFileDoesNotSaySo) {
  Hear("viewer 1");
  EXPECT_EQ(watch.timeout(), Duration());
}

// In a thread of its own, which waits for no lock of the structure.
TEST(OperatorWatchThread, PressesAndPressesAgain) {
  Runtime runtime;
  RobotStop& stop = runtime.robot_stop();
  const std::lock_guard lock(runtime.structure_mutex());
  OperatorWatch watch(stop);
  watch.Begin(20ms);
  WaitUntil("it presses", [&] { return stop.in_force(); });
  WaitUntil("it is noted", [&] { return stop.state().changes == 1; });
  ASSERT_TRUE(stop.Release("a button"));
  WaitUntil("it presses again", [&] { return stop.in_force(); });
}

}  // namespace
}  // namespace runnel::test

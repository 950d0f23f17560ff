// What an application with a network does not do while a recording is played into it.

#include <csignal>

#include <gmock/gmock.h>

#include "tests/integration/two_robots.h"

namespace runnel::test {
namespace {

using testing::HasSubstr;
using testing::Not;

using ReplayedApplications = TwoRobots;

TEST_F(ReplayedApplications, AReplayStaysOutOfTheNetworkAndSaysSo) {
  const std::string recording = folder_ / "planner.mcap";
  {
    const auto robot = Start("two_robots.xml");
    Program planner("run " + kApps + "two_robots_planner.xml --record " + recording);
    WaitUntilItDrives();
    planner.Send(SIGINT);
    const Ended ended = planner.Wait();
    ASSERT_EQ(ended.code, kDone) << ended.text;
  }
  const auto robot = Start("two_robots.xml");
  Program replay("replay " + recording + " " + kApps + "two_robots_planner.xml --loop");
  ASSERT_TRUE(replay.WaitFor("the network is left out: values come from a recording"));
  WaitForText("network --app planner", "the network is left out");
  // Who joins after it is seen, and it is not.
  const Program other("run " + Write("other", R"(  <network/>
  <module name="gate" type="motion/command_gate"/>
  <connect from="//planner/planner/twist" to="gate/wanted"/>
)"));
  WaitForText("network --app robot", "member other");
  EXPECT_THAT(Runnel("network --app robot").text, Not(HasSubstr("planner (")));
  EXPECT_THAT(Runnel("log --app robot").text, Not(HasSubstr("planner is in the network")));
  EXPECT_THAT(Runnel("set --app planner //robot/world/goal_x 1").text, HasSubstr("the network is left out"));
  replay.Send(SIGINT);
  const Ended ended = replay.Wait();
  EXPECT_EQ(ended.code, kDone) << ended.text;
  EXPECT_THAT(ended.text, HasSubstr("replayed"));
}

}  // namespace
}  // namespace runnel::test

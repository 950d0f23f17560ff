// Two processes that share a robot: one drives, one plans; killed, started again, and what others may say meanwhile.

#include <csignal>
#include <cstdlib>

#include <gmock/gmock.h>

#include "tests/integration/two_robots.h"

namespace runnel::test {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST_F(TwoRobots, APlannerThatIsKilledAndStartedAgainGoesOn) {
  const auto robot = Start("two_robots.xml");
  auto planner = Start("two_robots_planner.xml");
  WaitUntilItDrives();
  planner->Send(SIGKILL);
  ASSERT_TRUE(robot->WaitFor("published {forward: 0, turn: 0} at /robot/gate/input/wanted"));
  EXPECT_THAT(Runnel("get --app robot /gate/wanted").text, HasSubstr("{forward: 0, turn: 0}"));
  planner = Start("two_robots_planner.xml");
  ASSERT_TRUE(robot->WaitFor("values come again"));
  WaitUntilItDrives();
}

TEST_F(TwoRobots, APlannerThatIsHeldUpHoldsNobodyUpAndGoesOnWithWhatIsNew) {
  const auto robot = Start("two_robots.xml");
  const auto planner = Start("two_robots_planner.xml");
  WaitUntilItDrives();
  planner->Send(SIGSTOP);
  ASSERT_TRUE(robot->WaitFor("published {forward: 0, turn: 0} at /robot/gate/input/wanted"));
  planner->Send(SIGCONT);
  ASSERT_TRUE(robot->WaitFor("values come again"));
}

// The robot itself is not told: a twist that is stopped where it comes from stops who moves by it.
TEST_F(TwoRobots, AStopOfThePlannerStopsTheRobotAndNothingElseThatItSends) {
  const auto robot = Start("two_robots.xml");
  const auto planner = Start("two_robots_planner.xml");
  WaitUntilItDrives();
  ASSERT_EQ(Runnel("stop --app planner").code, kDone);
  WaitForText("get --app robot /gate/wanted", "{forward: 0, turn: 0}");
  EXPECT_THAT(Runnel("network --app planner").text, HasSubstr("STOPPED: its safe value is sent"));
  EXPECT_THAT(Runnel("network --app robot").text, Not(HasSubstr("STOPPED")));
  ASSERT_EQ(Runnel("release --app planner").code, kDone);
  WaitUntilItDrives();
  // What somebody sets by hand is sent, too.
  ASSERT_EQ(Runnel("publish --app planner /planner/output/twist '{forward: 0.125, turn: 0}'").code, kDone);
  WaitForText("get --app robot /gate/wanted", "forward: 0.125");
}

// Its port is true while the STOP is in force; no module has to know of it.
TEST_F(TwoRobots, AStopOfOneStopsTheOtherWhereTheFilesSaySo) {
  const Program planner(
      "run " + Write("planner", R"(  <group name="panel"><port name="stopped" type="bool" direction="output"/></group>
  <driving port="panel/stopped" safe="true"/>
  <network><offer port="panel/stopped" topic="/stop" as="std_msgs/msg/Bool"/><take topic="/cmd" to="gate/wanted"/></network>
  <module name="gate" type="motion/command_gate"/>
)"));
  Program base("run " +
               Write("base", R"(  <group name="panel"><port name="pressed" type="bool" direction="input"/></group>
  <stop_button port="panel/pressed"/>
  <network><take topic="/stop" as="std_msgs/msg/Bool" to="panel/pressed"/><take topic="/cmd" to="gate/wanted"/></network>
  <module name="gate" type="motion/command_gate"/>
)"));
  WaitForText("network --app planner", "read by base");
  ASSERT_EQ(Runnel("stop --app planner").code, kDone);
  ASSERT_TRUE(base.WaitFor("STOP, by the button /base/panel/pressed"));
  ASSERT_EQ(Runnel("release --app planner").code, kDone);
  const Ended released = Runnel("release --app base");  // somebody there releases it
  EXPECT_EQ(released.code, kDone) << released.text;
}

TEST_F(TwoRobots, ARobotThatIsKilledAndStartedAgainFindsItsPlannerAndTheLatchedGoal) {
  const auto planner = Start("two_robots_planner.xml");
  auto robot = Start("two_robots.xml");
  WaitUntilItDrives();
  robot->Send(SIGKILL);
  robot = Start("two_robots.xml");
  ASSERT_TRUE(robot->WaitFor("driving to the goal"));
}

#if RUNNEL_HAS_FAST
// Each engine is the other's foreign end.
TEST_F(TwoRobots, OneMayHaveAnotherEngineThanTheOther) {
  const auto robot = StartWith("two_robots.xml", "engine=\"fast\"");
  auto planner = Start("two_robots_planner.xml");
  WaitUntilItDrives();
  planner->Send(SIGKILL);
  ASSERT_TRUE(robot->WaitFor("published {forward: 0, turn: 0} at /robot/gate/input/wanted"));
  planner = StartWith("two_robots_planner.xml", "engine=\"fast\"");
  ASSERT_TRUE(robot->WaitFor("values come again"));
  WaitUntilItDrives();
}
#endif

TEST_F(TwoRobots, MistakesAreToldWithTheirPlaces) {
  const std::string file = folder_ / "wrong.xml";
  const auto check = [&](const std::string& network) {
    std::ofstream(file) << "<application name=\"base\">\n<load plugin=\"motion\"/>\n"
                        << network << "\n<module name=\"gate\" type=\"motion/command_gate\"/>\n</application>\n";
    return Runnel("check " + file).text;
  };
  EXPECT_THAT(check(R"(<network><offer port="gate/alowed"/></network>)"),
              testing::AllOf(HasSubstr("wrong.xml:3:23"), HasSubstr("did you mean 'allowed'?")));
  EXPECT_THAT(check(R"(<network><take topic="cmd vel" to="gate/wanted"/></network>)"),
              testing::AllOf(HasSubstr("wrong.xml:3:23"), HasSubstr("write '/cmd_vel'"), HasSubstr("1 error")));
  EXPECT_THAT(check(R"(<network reach="everywhere"/>)"), HasSubstr("loopback"));
  EXPECT_THAT(check(R"(<network domain="500"/>)"), HasSubstr("from 0 to 101"));
  EXPECT_THAT(check(R"(<network datagram="70000"/>)"), HasSubstr("from 1000 to 65500 octets"));
  EXPECT_THAT(check(R"(<network engine="carrier_pigeon"/>)"), HasSubstr("'carrier_pigeon' is not installed"));
  EXPECT_THAT(check(R"(<network/><network/>)"), HasSubstr("there is a network already"));
  EXPECT_THAT(check(R"(<network><offer ports="gate/*" topic="/x"/></network>)"),
              HasSubstr("topic is said of one port"));
  EXPECT_THAT(check(R"(<network><offer ports="gate/*" sending="after_cycles"/></network>)"),
              HasSubstr("did you mean 'after_cycle'?"));
  EXPECT_THAT(check(R"(<network><offer ports="gate/*" sending="after_cycle" rate="5"/></network>)"),
              testing::AllOf(HasSubstr("wrong.xml:3:60"), HasSubstr("by the network's thread"),
                             HasSubstr("leave out rate, or sending")));
  EXPECT_THAT(check(R"(<network><offer/></network>)"), HasSubstr("<offer> says which ports"));
  EXPECT_THAT(check(R"(<network><offer ports="gate/*" service="/x"/></network>)"),
              HasSubstr("service is said of one port"));
  EXPECT_THAT(check(R"(<network><offer ports="gate/*" strength="3000000000"/></network>)"),
              testing::AllOf(HasSubstr("wrong.xml:3:42"), HasSubstr("from 0 to 2147483647")));
  EXPECT_THAT(
      check("<network><offer port=\"gate/allowed\"/>\n<offer port=\"gate/allowed\" qos=\"latched\"/></network>"),
      testing::AllOf(HasSubstr("wrong.xml:4:14"), HasSubstr("is offered as /base/gate/allowed already, in line 3")));
}

TEST_F(TwoRobots, TheyFindEachOtherWithoutMulticast) {
  const auto robot = StartWith("two_robots.xml", "multicast=\"false\"");
  const auto planner = StartWith("two_robots_planner.xml", "multicast=\"false\"");
  WaitUntilItDrives();
}

TEST_F(TwoRobots, APortOfAnotherApplicationIsConnectedByItsPath) {
  const std::string file = folder_ / "follower.xml";
  std::ofstream(file) << R"(<application name="follower">
  <load plugin="motion"/>
  <network/>
  <module name="gate" type="motion/command_gate"/>
  <connect from="//planner/planner/twist" to="gate/wanted"/>
</application>
)";
  const auto robot = Start("two_robots.xml");
  const auto planner = Start("two_robots_planner.xml");
  const auto value = [](const std::string& port) { return Runnel("get --app follower " + port).text; };
  const Program follower("run " + file);
  WaitUntil("the twist has come", [&] { return value("/gate/wanted").find("forward: 0.") != std::string::npos; });
  EXPECT_THAT(Runnel("network --app follower").text,
              testing::AllOf(HasSubstr("member planner"), HasSubstr("written by planner (reliable, newest 1)"),
                             HasSubstr("written /robot/laser/scan  runnel_msgs::msg::dds_::RangeScan_ by robot")));
  EXPECT_THAT(Runnel("ls --app follower //planner/eyes").text,
              testing::AllOf(HasSubstr("surroundings"), Not(HasSubstr("twist"))));
  EXPECT_THAT(Runnel("ls --app follower //planner/eys").text, HasSubstr("did you mean 'eyes'?"));
  // While it runs, too, and back.
  ASSERT_EQ(Runnel("disconnect --app follower //planner/planner/twist /gate/wanted").code, kDone);
  const Ended wrong = Runnel("connect --app follower //robot/laser/scan /gate/wanted");
  EXPECT_EQ(wrong.code, kBadInput);
  EXPECT_THAT(wrong.text, testing::AllOf(HasSubstr("//robot/laser/scan"), HasSubstr("RangeScan")));
  EXPECT_THAT(Runnel("network --app follower").text, Not(HasSubstr("NOT MATCHED")));
  ASSERT_EQ(Runnel("undo --app follower").code, kDone);
  ASSERT_EQ(Runnel("connect --app follower //planner/planner/twst /gate/wanted").code, kDone);
  WaitUntil("the nearest name is told", [&] {
    return Runnel("log --app follower").text.find("did you mean '//planner/planner/twist'?") != std::string::npos;
  });
  ASSERT_EQ(Runnel("save --app follower").code, kDone);
  std::ifstream stream(file);
  const std::string saved{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_THAT(saved, testing::AllOf(HasSubstr("<connect from=\"//planner/planner/twist\" to=\"gate/wanted\"/>"),
                                    HasSubstr("<connect from=\"//planner/planner/twst\" to=\"gate/wanted\"/>")));
  EXPECT_EQ(Runnel("check " + file).code, kDone);
}

TEST_F(TwoRobots, SimulatedTimeTakesNothingFromElsewhereUnlessToldTo) {
  const std::string file = folder_ / "simulated.xml";
  std::ofstream(file) << R"(<application name="base"><load plugin="motion"/><clock type="simulated"/>
<network><take topic="/cmd_vel" to="gate/wanted"/></network>
<module name="gate" type="motion/command_gate"/></application>)";
  const Ended ended = Runnel("run --fast --duration 1 " + file);
  EXPECT_EQ(ended.code, kBadInput);
  EXPECT_THAT(ended.text, testing::AllOf(HasSubstr("simulated.xml:2:10"), HasSubstr("live=\"true\"")));
}

// Nothing is published any more when they come. The first reader of a port gets what is there in any case.
TEST_F(TwoRobots, WhoComesLateGetsWhatIsLatchedAndNothingElse) {
  const Program early("run " + Write("early", R"(  <network>
    <offer port="gate/allowed" topic="/kept" qos="latched"/>
    <offer port="gate/allowed" topic="/gone"/>
  </network>
  <module name="gate" type="motion/command_gate"/>
  <connect from="//nobody/twist" to="gate/wanted"/>
)"));
  WaitForText("get --app early /gate/allowed", "forward: 0");
  WaitForText("pause --app early /gate", "paused");
  const std::string reader = R"(  <network>
    <take topic="/kept" to="one/wanted"/>
    <take topic="/gone" to="other/wanted"/>
  </network>
  <module name="one" type="motion/command_gate"/>
  <module name="other" type="motion/command_gate"/>
)";
  const Program late("run " + Write("late", reader));
  WaitForText("network --app late", "network/gone  runnel_msgs::msg::dds_::Twist2_, reliable, newest 1, 1 came");
  const Program later("run " + Write("later", reader));
  WaitForText("network --app later",
              "network/kept  runnel_msgs::msg::dds_::Twist2_, reliable, latched, newest 1, 1 came");
  EXPECT_THAT(Runnel("get --app later /one/wanted").text, HasSubstr("forward: 0"));
  EXPECT_THAT(Runnel("network --app later").text,
              HasSubstr("network/gone  runnel_msgs::msg::dds_::Twist2_, reliable, newest 1, 0 came"));
}

}  // namespace
}  // namespace runnel::test

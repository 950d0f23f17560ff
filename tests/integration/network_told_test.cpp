// What people are told, and by whom, where several applications are running.

#include <csignal>

#include <gmock/gmock.h>

#include "tests/integration/two_robots.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

using NetworkTold = TwoRobots;

const std::string kEyes = R"(  <network/>
  <module name="gate" type="motion/command_gate"/>
  <connect from="//nobody/twist" to="gate/wanted"/>
)";

TEST_F(NetworkTold, CommandsOfTwoApplicationsNeedNotSayWhich) {
  const auto robot = Start("two_robots.xml");
  const auto planner = Start("two_robots_planner.xml");
  WaitUntilItDrives();
  const auto told = [](const std::string& command) {
    const Ended ended = Runnel(command);
    EXPECT_EQ(ended.code, kDone) << command << ": " << ended.text;
    return ended.text;
  };
  EXPECT_THAT(told("network"), AllOf(HasSubstr("robot in domain"), HasSubstr("planner in domain")));
  EXPECT_THAT(told("ls //robot/laser"), HasSubstr("scan"));
  told("set //planner/planner/cruise_speed 0.2");
  EXPECT_THAT(told("ls //planner"), ContainsRegex("cruise_speed +parameter +double = 0.2"));
  // Of one that is not running here who has a network knows more.
  EXPECT_THAT(Runnel("set //robt/world/goal_x 4").text, HasSubstr("did you mean '//robot'?"));
  const Program lonely("run " + Write("lonely",
                                      "  <module name=\"gate\" type=\"motion/command_gate\"/>\n  <connect "
                                      "from=\"gate/allowed\" to=\"gate/wanted\" late=\"true\"/>\n"));
  WaitForText("ps", "lonely");
  EXPECT_THAT(told("network"), AllOf(HasSubstr("robot in domain"), Not(HasSubstr("lonely"))));
}

TEST_F(NetworkTold, AConnectionIsForTheApplicationThatHasItsInput) {
  const auto planner = Start("two_robots_planner.xml");
  const Program follower("run " + Write("follower", kEyes));
  WaitForText("network --app follower", "member planner");
  EXPECT_EQ(Runnel("disconnect //nobody/twist /follower/gate/wanted").code, kDone);
  EXPECT_EQ(Runnel("connect //planner/planner/twist /gate/wanted").code, kDone);
  WaitForText("network --app follower", "written by planner");
}

TEST_F(NetworkTold, AnOutputThatNobodyUsesAnyMoreIsMadeOfTheTypeThatIsWanted) {
  const std::string file = Write("follower", R"(  <load plugin="planning"/>
  <load plugin="adaptors"/>
  <network/>
  <module name="eyes" type="adaptors/laser"/>
  <module name="gate" type="motion/command_gate"/>
  <connect from="//robot/localisation/pose" to="eyes/pose"/>
  <connect from="//nobody/scan" to="eyes/scan"/>
  <connect from="//robot/laser/scan" to="gate/wanted"/>
)");
  const Program follower("run " + file);
  WaitForText("network --app follower", "takes /robot/laser/scan");
  ASSERT_EQ(Runnel("disconnect --app follower //robot/laser/scan /gate/wanted").code, kDone);
  ASSERT_EQ(Runnel("disconnect --app follower //nobody/scan /eyes/scan").code, kDone);
  const Ended right = Runnel("connect --app follower //robot/laser/scan /eyes/scan");
  ASSERT_EQ(right.code, kDone) << right.text;
  const auto robot = Start("two_robots.xml");
  WaitUntil("scans come", [] { return Runnel("get --app follower /eyes/scan").code == kDone; });
  EXPECT_THAT(Runnel("network --app follower").text, Not(HasSubstr("NOT MATCHED")));
}

TEST_F(NetworkTold, MessagesOfRos2AreConnectedAsTheirWriterSaysOrRefused) {
  const Program base("run " + Write("base", R"(  <network>
    <offer port="gate/allowed" topic="/cmd_vel" as="geometry_msgs/msg/Twist" qos="latched"/>
  </network>
  <module name="gate" type="motion/command_gate"/>
  <connect from="//nobody/twist" to="gate/wanted"/>
)"));
  const std::string file = Write("follower",
                                 "  <load plugin=\"signal\"/>\n  <module name=\"line\" type=\"signal/linear\"/>\n  "
                                 "<connect from=\"//nobody/number\" to=\"line/in\"/>\n" +
                                     kEyes);
  auto follower = std::make_unique<Program>("run " + file);
  WaitForText("network --app follower", "written /cmd_vel");
  const Ended refused = Runnel("connect --app follower //cmd_vel /line/in");
  EXPECT_EQ(refused.code, kBadInput);
  EXPECT_THAT(refused.text, HasSubstr("runnel take /cmd_vel PORT --as geometry_msgs/msg/Twist"));
  ASSERT_EQ(Runnel("disconnect --app follower //nobody/twist /gate/wanted").code, kDone);
  const Ended connected = Runnel("connect --app follower //cmd_vel /gate/wanted");
  ASSERT_EQ(connected.code, kDone) << connected.text;
  ASSERT_EQ(Runnel("publish --app base /gate/wanted '{forward: 0.25, turn: 0}' --rate 20").code, kDone);
  WaitForText("get --app follower /gate/wanted", "forward: 0.25");
  EXPECT_THAT(Runnel("ls --long --app base /gate").text,
              AllOf(HasSubstr(", to the network"), Not(HasSubstr("offer_"))));
  ASSERT_EQ(Runnel("save --app follower").code, kDone);
  EXPECT_THAT(Read(file), HasSubstr(R"(<connect from="//cmd_vel" to="gate/wanted"/>)"));
  // What the file does not say is found again when the writer is.
  follower->Send(SIGTERM);
  EXPECT_EQ(follower->Wait().code, kDone);
  follower = std::make_unique<Program>("run " + file);
  WaitForText("get --app follower /gate/wanted", "forward: 0.25");
}

TEST_F(NetworkTold, WhatWouldDoNothingInAFileIsTold) {
  const std::string file = folder_ / "wrong.xml";
  const auto check = [&](const std::string& network) {
    std::ofstream(file) << "<application name=\"base\">\n<load plugin=\"motion\"/>\n"
                        << network
                        << "\n<module name=\"gate\" type=\"motion/command_gate\"/>\n<connect from=\"//nobody/twist\" "
                           "to=\"gate/wanted\"/>\n</application>\n";
    return Runnel("check " + file).text;
  };
  EXPECT_THAT(check(R"(<network><offer ports="gate/* gtae/*"/></network>)"),
              AllOf(HasSubstr("wrong.xml:3:24"), HasSubstr("did you mean 'gate/*'?")));
  EXPECT_THAT(check(R"(<network><offer ports="gate/* !**/state"/></network>)"), Not(HasSubstr("means no port")));
  EXPECT_THAT(check(R"(<network reach="network" peers="10.0.0.300"/>)"),
              AllOf(HasSubstr("wrong.xml:3:33"), HasSubstr("'10.0.0.300' is no address")));
  EXPECT_THAT(check(R"(<network peers="10.0.0.2"/>)"),
              AllOf(HasSubstr("wrong.xml:3:17"), HasSubstr("reach=\"loopback\"")));
  EXPECT_THAT(check(R"(<network reach="network" peers="nobody.invalid"/>)"),
              HasSubstr("no machine is known here by the name 'nobody.invalid'"));
  EXPECT_THAT(
      check(R"(<network><offer port="gate/allowed" topic="/x"/><offer port="gate/state" topic="/x"/></network>)"),
      AllOf(HasSubstr("the topic /x has values of /base/gate/output/allowed already"),
            HasSubstr("runnel_msgs/msg/Twist2, and not std_msgs/msg/UInt32")));
  EXPECT_THAT(check(R"(<network><ros distribution="jazzy"/></network>)"),
              AllOf(HasSubstr("wrong.xml:3:10"), HasSubstr("reach=\"machine\"")));
  EXPECT_THAT(check(R"(<network reach="machine"><ros distribution="jazzy"/></network>)"),
              Not(HasSubstr("are not met")));
  EXPECT_THAT(check(R"(<network messages="nothere"/>)"),
              AllOf(HasSubstr("wrong.xml:3:20"), HasSubstr("there is no file and no folder")));
  EXPECT_THAT(check(R"(<network engine="cyclon"/>)"),
              AllOf(HasSubstr("wrong.xml:3:18"), HasSubstr("did you mean 'cyclone'?")));
  (void)check(R"(<network reach="network" interface="wlan7"/>)");
  const Ended ended = Runnel("run --duration 0.1 " + file);
  EXPECT_NE(ended.code, kDone);
  EXPECT_THAT(ended.text, AllOf(HasSubstr("there is no interface 'wlan7'"), HasSubstr("lo (127.0.0.1)")));
}

TEST_F(NetworkTold, WhereAPathOfAnotherApplicationIsNoUseIsTold) {
  const Program follower("run " + Write("follower", kEyes));
  WaitForText("network --app follower", "takes /nobody/twist");
  EXPECT_THAT(Runnel("connect /gate/allowed //nobody/wanted").text,
              HasSubstr("inputs of another application are connected there"));
  EXPECT_THAT(Runnel("connect //nobody /gate/wanted").text,
              HasSubstr("waits for //nobody: nobody is not in the network yet"));
  EXPECT_EQ(Runnel("disconnect //nobody /gate/wanted").code, kDone);
  EXPECT_THAT(Runnel("get //nobdy/twist").text, HasSubstr("nobdy is not in the network yet"));
  const Program other("run " + Write("planer", kEyes));
  WaitForText("network --app follower", "member planer");
  ASSERT_EQ(Runnel("disconnect --app follower //nobody/twist /gate/wanted").code, kDone);
  const Ended typo = Runnel("connect --app follower //planner/gate/allowed /gate/wanted");
  EXPECT_EQ(typo.code, kDone);
  EXPECT_THAT(typo.text, AllOf(HasSubstr("planner is not in the network yet"), HasSubstr("did you mean '//planer'?")));
  // The output that stands for it is recorded as any.
  const std::string recording = folder_ / "told.mcap";
  const Ended recorded = Runnel("record --app follower //planner/gate/allowed -n 1 -o " + recording);
  EXPECT_EQ(recorded.code, kDone) << recorded.text;
}

}  // namespace
}  // namespace runnel::test

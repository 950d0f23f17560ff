// Parts of what another application has, before it is there and after.

#include <csignal>

#include <gmock/gmock.h>

#include "tests/integration/two_robots.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

using NetworkParts = TwoRobots;

const std::string kDisplay = R"(  <load plugin="planning"/>
  <load plugin="sensors"/>
  <load plugin="signal"/>
  <network/>
  <module name="place" type="signal/linear"/>
  <module name="range" type="signal/linear"/>
  <module name="spare" type="signal/linear"/>
  <connect from="//robot/localisation/pose.x" to="place/in"/>
  <connect from="place/out" to="range/in spare/in"/>
)";

std::string Told(const std::string& command, int code) {
  const Ended ended = Runnel(command);
  EXPECT_EQ(ended.code, code) << command << ": " << ended.text;
  return ended.text;
}

TEST_F(NetworkParts, AreConnectedWhenTheOtherApplicationTellsWhatTheyAreOf) {
  const std::string file = Write("display", kDisplay);
  const std::string before = Read(file);
  EXPECT_EQ(Runnel("check " + file).code, kDone);
  const Program display("run " + file);
  WaitForText("network --app display", "waits for //robot/localisation/pose.x to /display/place/input/in");
  EXPECT_THAT(Runnel("network --app display").text, HasSubstr("robot is not in the network yet"));
  // What waits is a connection as any.
  EXPECT_THAT(Told("connect --app display //robot/laser/scan.ranges[0] /range/in", kDone),
              HasSubstr("waits for //robot/laser/scan.ranges[0]: robot is not in the network yet"));
  Told("save --app display", kDone);
  EXPECT_THAT(Read(file), HasSubstr(R"(<connect from="//robot/laser/scan.ranges[0]" to="range/in"/>)"));
  Told("undo --app display", kDone);
  Told("save --app display", kDone);
  EXPECT_EQ(Read(file), before);
  Told("redo --app display", kDone);
  EXPECT_THAT(Told("ls --app display", kDone), HasSubstr("waits: robot is not in the network yet"));
  EXPECT_THAT(Told("swap --app display /place motion/command_gate", kBadInput), HasSubstr("no port 'in'"));
  Told("delete --app display /place", kDone);
  EXPECT_THAT(Told("ls --app display", kDone), Not(HasSubstr("localisation")));
  Told("undo --app display", kDone);
  auto robot = Start("two_robots.xml");
  WaitUntil("both come", [] {
    return Runnel("get --app display /place/in").code == kDone &&
           Runnel("ls --app display").text.find("->") == std::string::npos;
  });
  EXPECT_THAT(Told("connect --app display //robot/localisation/pose.z /spare/in", kBadInput),
              AllOf(HasSubstr("Pose2 has no field 'z'"), HasSubstr("did you mean 'x'?")));
  EXPECT_THAT(Told("connect --app display //robot/laser/scam.ranges[0] /spare/in", kDone),
              HasSubstr("did you mean '//robot/laser/scan'?"));
  Told("undo --app display", kDone);
  Told("swap --app display /place signal/dead_band", kDone);
  Told("undo --app display", kDone);
  Told("disconnect --app display //robot/localisation/pose /place/in", kDone);
  Told("undo --app display", kDone);
  Told("save --app display", kDone);
  EXPECT_THAT(Read(file), AllOf(HasSubstr(R"(<connect from="//robot/localisation/pose.x" to="place/in"/>)"),
                                HasSubstr(R"(<connect from="//robot/laser/scan.ranges[0]" to="range/in"/>)")));
  Told("undo --app display", kDone);
  robot->Send(SIGKILL);
  EXPECT_EQ(robot->Wait().signal, SIGKILL);
  const std::string stood = Runnel("get --app display /place/in").text;
  robot = Start("two_robots.xml");
  const auto planner = Start("two_robots_planner.xml");
  WaitUntil("it drives", [&] { return Runnel("get --app display /place/in").text != stood; });
}

TEST_F(NetworkParts, ThatAreWrongAreToldWhenTheOtherApplicationComes) {
  std::string text = kDisplay;
  text.replace(text.find("pose.x"), 6, "pose.z");
  const Program display("run " + Write("display", text));
  WaitForText("network --app display", "robot is not in the network yet");
  const auto robot = Start("two_robots.xml");
  WaitForText("log --app display", "waits for //robot/localisation/pose.z: ");
  WaitForText("network --app display", "'z'");
}

}  // namespace
}  // namespace runnel::test

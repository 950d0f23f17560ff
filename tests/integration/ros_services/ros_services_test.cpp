// Services of ROS 2: called by another program, whose types are made by another's compiler, and had by it.

#include <csignal>
#include <cstdlib>
#include <fstream>

#include <gmock/gmock.h>

#include "tests/integration/program.h"
#include "tests/support/own_network.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class ServicesOfRos : public testing::Test {
 protected:
  ServicesOfRos() {
    setenv("ROS_DOMAIN_ID", std::to_string(OwnDomain()).c_str(), 1);
    setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1);
  }
  ~ServicesOfRos() override {
    unsetenv("XDG_RUNTIME_DIR");
    unsetenv("ROS_DOMAIN_ID");
  }
  /// A file of this name with the lines in its application; "run" or "check" and its path are the arguments.
  std::string Arguments(const std::string& command, const std::string& name, const std::string& lines,
                        const std::string& period = "20ms") {
    const std::string path = folder_ / (name + ".xml");
    std::ofstream(path) << "<application name=\"" << name << "\" thread=\"control\">\n<load plugin=\"switches\"/>\n"
                        << "<thread name=\"control\" period=\"" << period << "\"/>\n"
                        << lines << "\n</application>\n";
    return command + " " + path;
  }
  static Program Node(const std::string& what) {
    return Program(std::to_string(OwnDomain()) + " " + what, RUNNEL_ROS_NODE);
  }

  const TemporaryFolder folder_;
};

constexpr const char* kHouse = R"(<module name="lamp" type="switches/lamp"/>
  <network name="house">
    <offer port="lamp/set" service="/lamp/switch" as="std_srvs/srv/SetBool"/>
    <offer port="lamp/warm" as="std_srvs/Trigger" service="/lamp/warm"/>
    <offer port="lamp/reset" service="/lamp/reset" as="std_srvs/srv/Empty"/>
    <offer port="lamp/set"/>
  </network>)";

TEST_F(ServicesOfRos, TheStopIsPressedByNodesAndReleasedWhereTheFileSaysSo) {
  const std::string with_ros =
      std::string(kHouse).replace(std::string(kHouse).find("<offer"), 0, "<ros distribution=\"jazzy\"/>\n");
  {
    const Program house(Arguments("run", "house", with_ros));
    const Ended called = Node("stop").Wait();
    EXPECT_THAT(called.text, AllOf(HasSubstr("stop 1: refused 'STOP is in force, but no port"),
                                   HasSubstr("stop 0: refused 'the STOP is not released")));
    EXPECT_THAT(Runnel("ps").text, AllOf(HasSubstr("STOP"), HasSubstr("the service /house/stop")));
  }
  const std::string may_release =
      std::string(with_ros).replace(with_ros.find("<ros "), 5, "<ros stop_releases=\"true\" ");
  const Program house(Arguments("run", "house", may_release));
  EXPECT_THAT(Node("stop").Wait().text, HasSubstr("stop 0: done 'the STOP is released'"));
}

// Its port is true while the STOP is in force, and a button of the other one.
TEST_F(ServicesOfRos, AStopOfOneByItsServiceStopsTheOtherWhereTheFilesSaySo) {
  const Program house(Arguments("run", "house", R"(<module name="lamp" type="switches/lamp"/>
  <group name="panel"><port name="stopped" type="bool" direction="output"/></group>
  <driving port="panel/stopped" safe="true"/>
  <network name="house"><ros distribution="jazzy"/><offer port="panel/stopped" topic="/stopped" as="std_msgs/msg/Bool"/></network>)"));
  Program room(Arguments("run", "room", R"(<module name="lamp" type="switches/lamp"/>
  <group name="panel"><port name="pressed" type="bool" direction="input"/></group>
  <stop_button port="panel/pressed"/>
  <network name="room"><take topic="/stopped" as="std_msgs/msg/Bool" to="panel/pressed"/></network>)"));
  WaitUntil("they have found each other",
            [] { return Runnel("network --app house").text.find("read by room") != std::string::npos; });
  EXPECT_THAT(Node("stop").Wait().text, HasSubstr("stop 1: done 'the robot is stopped'"));
  ASSERT_TRUE(room.WaitFor("STOP, by the button /room/panel/pressed"));
  const std::string both = Runnel("ps").text;
  EXPECT_THAT(both, AllOf(HasSubstr("by the service /house/stop"), HasSubstr("by the button /room/panel/pressed")));
}

TEST_F(ServicesOfRos, AreOfferedToNodes) {
  const Program house(Arguments("run", "house", kHouse));
  Program node = Node("call");
  const Ended called = node.Wait();
  EXPECT_EQ(called.code, 0);
  EXPECT_THAT(
      called.text,
      AllOf(HasSubstr("switch 1: done 'it burns'"), HasSubstr("switch 2: refused 'it burns for ever'"),
            HasSubstr("switch 3: done 'it burns'"), HasSubstr("warm: done 'it is warm'"), HasSubstr("reset: done")));
  EXPECT_THAT(Runnel("get /lamp/lit").text, HasSubstr("false"));
  EXPECT_THAT(Runnel("network").text,
              AllOf(HasSubstr("/lamp/switch  std_srvs::srv::dds_::SetBool_Request_, 2 answered, 1 failed"),
                    HasSubstr("/house/lamp/set  runnel_msgs::srv::dds_::StringBool_Request_")));
}

TEST_F(ServicesOfRos, AnswerAlsoWhoseReaderIsNotKnownYet) {
  const Program house(Arguments("run", "house", kHouse));
  EXPECT_TRUE(Node("call_early").WaitFor("early: done 'it burns'"));
}

TEST_F(ServicesOfRos, GoOnWithAModuleThatTakesTheOthersPlace) {
  const Program house(Arguments("run", "house", kHouse));
  EXPECT_THAT(Node("call").Wait().text, HasSubstr("reset: done"));
  ASSERT_EQ(Runnel("swap /lamp switches/lamp").code, kDone);
  EXPECT_THAT(Node("call").Wait().text, HasSubstr("reset: done"));
}

constexpr const char* kRoom = R"(<module name="button" type="switches/button"/>
  <network name="room"> <take service="/house/switch" as="std_srvs/srv/SetBool" to="button/set"/> </network>)";

TEST_F(ServicesOfRos, AreCalledWhereNodesHaveThem) {
  Program room(Arguments("run", "room", kRoom));
  ASSERT_TRUE(room.WaitFor("timed_out: there is no service /house/switch in the network"));
  auto node = std::make_unique<Program>(std::to_string(OwnDomain()) + " serve", RUNNEL_ROS_NODE);
  ASSERT_TRUE(room.WaitFor("answered: lights are on"));
  ASSERT_TRUE(room.WaitFor("failed: the fuse is out"));
  EXPECT_THAT(Runnel("network").text, HasSubstr("takes the service /house/switch"));
  node->Send(SIGKILL);
  node = std::make_unique<Program>(std::to_string(OwnDomain()) + " serve", RUNNEL_ROS_NODE);
  ASSERT_TRUE(node->WaitFor("asked 1: on"));
}

TEST_F(ServicesOfRos, GoFromOneApplicationToAnother) {
  const Program house(Arguments("run", "house", kHouse));
  Program room(Arguments("run", "room", R"(<module name="button" type="switches/button"/>
    <network name="room"> <take service="/house/lamp/set" to="button/set"/> </network>)"));
  EXPECT_TRUE(room.WaitFor("answered: it burns"));
}

std::string HouseWith(const std::string& ros) {
  return R"(<module name="lamp" type="switches/lamp"/> <network name="house"> <ros distribution="jazzy" )" + ros +
         "/> </network>";
}

TEST_F(ServicesOfRos, ShowParametersAndSetThem) {
  const Program house(Arguments("run", "house", HouseWith("parameters=\"write\"")));
  Program events = Node("events");
  ASSERT_TRUE(events.WaitFor("listening"));
  const Ended node = Node("parameters").Wait();
  EXPECT_EQ(node.code, 0);
  EXPECT_THAT(node.text,
              AllOf(HasSubstr("listed lamp.is_broken\nlisted lamp.level\nlisted lamp.make\nprefix lamp\n"),
                    HasSubstr("type 0 is 1\ntype 1 is 3\ntype 2 is 0\n"),
                    HasSubstr("described lamp.level: 'how bright [cd]' open from 0 to 10\n"),
                    HasSubstr("set 0: done ''\n"), HasSubstr("set 1: refused '"),
                    HasSubstr("set 2: refused 'there is no parameter 'lamp.levl'; did you mean 'lamp.level'?'"),
                    HasSubstr("set 3: refused '"), HasSubstr("together: refused '"),
                    HasSubstr("got lamp.is_broken false\ngot lamp.level 3.500000\ngot lamp.nothing type 0\n")));
  EXPECT_TRUE(events.WaitFor("event of /house\nchanged lamp.level 3.500000"));
  EXPECT_EQ(Runnel("undo").code, kDone);
  EXPECT_TRUE(events.WaitFor("changed lamp.level 1.000000"));
}

TEST_F(ServicesOfRos, SetNoParameterUnlessTheFileAllowsIt) {
  const Program house(Arguments("run", "house", HouseWith("parameters=\"read\"")));
  const Ended node = Node("parameters").Wait();
  EXPECT_THAT(node.text, AllOf(HasSubstr("described lamp.level: 'how bright [cd]' read only"),
                               HasSubstr("set 0: refused 'parameters may not be set from elsewhere; the application's "
                                         "file is to say <ros parameters=\"write\"/>'"),
                               HasSubstr("got lamp.level 1.000000")));
}

TEST_F(ServicesOfRos, TellHowTheApplicationIs) {
  const Program house(Arguments("run", "house", HouseWith("diagnostics=\"true\"")));
  Program node = Node("diagnostics");
  ASSERT_TRUE(node.WaitFor("level 0 house: modules: no fault"));
  ASSERT_TRUE(node.WaitFor("house: thread control: "));
  EXPECT_EQ(Runnel("set /lamp/is_broken true").code, kDone);
  EXPECT_TRUE(node.WaitFor("level 2 house: modules: 1 failed"));
  EXPECT_TRUE(node.WaitFor("level 2 house: /house/lamp: the wire is through"));
}

TEST_F(ServicesOfRos, TellWhichInputHearsNothing) {
  const Program house(Arguments("run", "house", R"(<load plugin="motion"/> <module name="lamp" type="switches/lamp"/>
    <module name="gate" type="motion/command_gate"/>
    <network name="house"> <take topic="/cmd_vel" as="geometry_msgs/msg/Twist" to="gate/wanted"/>
      <ros distribution="jazzy" diagnostics="true"/> </network>
    <on_stale input="gate/wanted" after="100ms"> <publish port="gate/wanted" value="{forward: 0, turn: 0}"/> </on_stale>)"));
  Program node = Node("diagnostics");
  EXPECT_TRUE(node.WaitFor("level 3 house: /house/gate/input/wanted: nothing new for"));
}

TEST_F(ServicesOfRos, TellTheTime) {
  Program house(Arguments("run", "house", "<clock type=\"outside\"/>" + HouseWith("clock=\"follow\"")));
  Program node = Node("clock");
  WaitUntil("its time is that of the node", [] {
    const std::string text = Runnel("ls --long /threads").text;
    return text.find("period 20.000 ms (20.000 .. 20.000)") != std::string::npos;
  });
}

TEST_F(ServicesOfRos, TellNoTimeToClocksOfOthers) {
  const Ended run = Runnel(Arguments("run", "house", HouseWith("clock=\"follow\"")));
  EXPECT_EQ(run.code, kBadInput);
  EXPECT_THAT(run.text, HasSubstr("say <clock type=\"outside\"/>, or leave clock=\"follow\" out"));
}

#ifdef RUNNEL_FAST_NODE
// Where requests and replies say beside the message which call they belong to.
std::string OverFastDds(std::string lines) {
  return lines.replace(lines.find("<network "), 9, "<network engine=\"fast\" reach=\"machine\" ");
}

TEST_F(ServicesOfRos, GoOverFastDdsAsWell) {
  const Program house(Arguments("run", "house", OverFastDds(kHouse)));
  Program room(Arguments("run", "room", R"(<module name="button" type="switches/button"/>
    <network engine="fast" name="room" reach="machine"> <take service="/lamp/switch" as="std_srvs/srv/SetBool" to="button/set"/> </network>)"));
  EXPECT_TRUE(room.WaitFor("answered: it burns"));
}

TEST_F(ServicesOfRos, AreOfferedToNodesOnFastDds) {
  const Program house(Arguments("run", "house", OverFastDds(kHouse)));
  Program node(std::to_string(OwnDomain()) + " call", RUNNEL_FAST_NODE);
  const Ended called = node.Wait();
  EXPECT_EQ(called.code, 0);
  EXPECT_EQ(called.text,
            "switch 1: done 'it burns'\nswitch 2: refused 'it burns for ever'\nswitch 3: done 'it burns'\nwarm: done "
            "'it is warm'\n");
  EXPECT_THAT(Runnel("network").text,
              HasSubstr("/lamp/switch  std_srvs::srv::dds_::SetBool_Request_, 2 answered, 1 failed"));
}

class OfFastDds : public ServicesOfRos, public testing::WithParamInterface<const char*> {};

TEST_P(OfFastDds, AreCalledWhereNodesHaveThem) {
  Program room(Arguments("run", "room", OverFastDds(kRoom)));
  ASSERT_TRUE(room.WaitFor("timed_out: there is no service /house/switch in the network"));
  Program node(std::to_string(OwnDomain()) + " " + GetParam(), RUNNEL_FAST_NODE);
  ASSERT_TRUE(node.WaitFor("asked 1: on"));
  ASSERT_TRUE(node.WaitFor("asked 3: on"));  // after what came of the second
  room.Send(SIGINT);
  EXPECT_THAT(room.Wait().text, AllOf(HasSubstr("answered: lights are on"), HasSubstr("failed: the fuse is out"),
                                      Not(HasSubstr("the lights of others"))));
}

INSTANTIATE_TEST_SUITE_P(Services, OfFastDds, testing::Values("serve", "serve_plain"));
#endif

TEST_F(ServicesOfRos, MistakesAreToldWithTheirPlaces) {
  const Ended checked = Runnel(Arguments("check", "wrong", R"(<module name="lamp" type="switches/lamp"/>
    <module name="button" type="switches/button"/>
    <network name="wrong">
      <offer port="lamp/set" as="std_srvs/srv/SetBol"/>
      <offer port="lamp/lit" service="/lit"/>
      <offer port="lamp/set" qos="sensor"/>
      <offer port="lamp/reset" as="std_srvs/srv/SetBool"/>
      <offer port="lamp/warm" service="a b"/>
      <take to="button/set"/>
      <take service="/x" topic="/y" to="button/set"/>
    </network>)"));
  EXPECT_EQ(checked.code, kBadInput);
  EXPECT_THAT(
      checked.text,
      AllOf(HasSubstr("there is no service type 'std_srvs/srv/SetBol'; did you mean 'std_srvs/srv/SetBool'?"),
            HasSubstr("lamp/output/lit is no service"), HasSubstr("qos is said of topics, and this is a service"),
            HasSubstr("has nothing of a std_srvs/srv/SetBool_Request"),
            HasSubstr("<take> says which topic, or which service"),
            HasSubstr("topic is said of topics, and this is a service")));
}

}  // namespace
}  // namespace runnel::test

// Services of ROS 2: called by another program, whose types are made by another's compiler, and had by it.

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
  std::string Arguments(const std::string& command, const std::string& name, const std::string& lines) {
    const std::string path = folder_ / (name + ".xml");
    std::ofstream(path) << "<application name=\"" << name << "\" thread=\"control\">\n<load plugin=\"switches\"/>\n"
                        << "<thread name=\"control\" period=\"20ms\"/>\n" << lines << "\n</application>\n";
    return command + " " + path;
  }
  static Program Node(const std::string& what) { return Program(std::to_string(OwnDomain()) + " " + what, RUNNEL_ROS_NODE); }

  const TemporaryFolder folder_;
};

constexpr const char* kHouse = R"(<module name="lamp" type="switches/lamp"/>
  <network name="house">
    <offer port="lamp/set" service="/lamp/switch" as="std_srvs/srv/SetBool"/>
    <offer port="lamp/warm" as="std_srvs/Trigger" service="/lamp/warm"/>
    <offer port="lamp/reset" service="/lamp/reset" as="std_srvs/srv/Empty"/>
    <offer port="lamp/set"/>
  </network>)";

TEST_F(ServicesOfRos, AreOfferedToNodes) {
  const Program house(Arguments("run", "house", kHouse));
  Program node = Node("call");
  const Ended called = node.Wait();
  EXPECT_EQ(called.code, 0);
  EXPECT_THAT(called.text, AllOf(HasSubstr("switch 1: done 'it burns'"), HasSubstr("switch 2: refused 'it burns for ever'"),
                                 HasSubstr("switch 3: done 'it burns'"), HasSubstr("warm: done 'it is warm'"),
                                 HasSubstr("reset: done")));
  EXPECT_THAT(Runnel("get /lamp/lit").text, HasSubstr("false"));
  EXPECT_THAT(Runnel("network").text,
              AllOf(HasSubstr("/lamp/switch  std_srvs::srv::dds_::SetBool_Request_, 2 answered, 1 failed"),
                    HasSubstr("/house/lamp/set  runnel_msgs::srv::dds_::StringBool_Request_")));
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
  EXPECT_THAT(checked.text,
              AllOf(HasSubstr("there is no service type 'std_srvs/srv/SetBol'; did you mean 'std_srvs/srv/SetBool'?"),
                    HasSubstr("lamp/output/lit is no service"), HasSubstr("qos is said of topics, and this is a service"),
                    HasSubstr("has nothing of a std_srvs/srv/SetBool_Request"),
                    HasSubstr("<take> says which topic, or which service"),
                    HasSubstr("topic is said of topics, and this is a service")));
}

}  // namespace
}  // namespace runnel::test

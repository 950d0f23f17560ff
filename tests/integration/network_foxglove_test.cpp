// A node of ROS 2 that is Foxglove's own, from the datagrams on (npm: @foxglove/ros2, @foxglove/rtps): it finds the
// application, its topics and types, and reads its values.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>

#include "tests/integration/program.h"
#include "tests/integration/ros_robot.h"
#include "tests/support/own_network.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;

/// The name of an engine.
class FoxgloveNode : public testing::TestWithParam<const char*> {
 protected:
  FoxgloveNode() { setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1); }
  ~FoxgloveNode() override { unsetenv("XDG_RUNTIME_DIR"); }

  const TemporaryFolder folder_;
};

TEST_P(FoxgloveNode, FindsTopicsAndReadsValues) {
  if (!std::filesystem::exists(RUNNEL_FOXGLOVE_NODE "/node_modules/@foxglove/ros2")) {
    GTEST_SKIP() << "npm could not install Foxglove's libraries when this was built";
  }
  // By another interface it would not hear those on loopback; without a way for multicast it hears nobody.
  if (OwnDomain() != 0 || std::system("ip route replace 224.0.0.0/4 dev lo") != 0)
    GTEST_SKIP() << "needs the right to make networks";
  std::ofstream(folder_ / "robot.xml") << RosRobot(GetParam());
  Program robot("run " + std::string(folder_ / "robot.xml") + " world=" RUNNEL_XML "/worlds/rooms.xml");
  Program node(RUNNEL_FOXGLOVE_NODE
               "/listen.mjs /scan=sensor_msgs/msg/LaserScan /tf_static=tf2_msgs/msg/TFMessage"
               " /clock=rosgraph_msgs/msg/Clock",
               RUNNEL_NODE);
  EXPECT_TRUE(node.WaitFor("all have come"));
  robot.Send(SIGINT);
  robot.Wait();
  const Ended ended = node.Wait();
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(
      ended.text,
      AllOf(HasSubstr("participant enclave=/;"),  // ros2 node list shows those only
            HasSubstr("topic /scan sensor_msgs/msg/LaserScan\n"),
            HasSubstr("topic /tf_static tf2_msgs/msg/TFMessage\n"), HasSubstr("topic /clock rosgraph_msgs/msg/Clock\n"),
            HasSubstr("writer rt/scan sensor_msgs::msg::dds_::LaserScan_ typehash=RIHS01_64c19139"),
            HasSubstr("reader rt/cmd_vel geometry_msgs::msg::dds_::Twist_ typehash=RIHS01_9c45bf16"),
            HasSubstr("writer ros_discovery_info rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_")));
  // As text by its reader: floats as they are, times as they were sent.
  EXPECT_THAT(
      ended.text,
      AllOf(
          ContainsRegex("value /scan .\"header\":.\"stamp\":.\"sec\":[0-9]+,\"nsec\":[0-9]+.,\"frame_id\":\"laser\".,"
                        "\"angle_min\":-1.57079[0-9]*,\"angle_max\":1.57079[0-9]*,\"angle_increment\":0.01745[0-9]*,"),
          ContainsRegex("\"range_min\":0.01999[0-9]*,\"range_max\":4,\"ranges\":.(\"Infinity\",)*[0-3]\\.[0-9]+,"),
          HasSubstr(
              R"("frame_id":"map"},"child_frame_id":"start","transform":{"translation":{"x":-5.5,"y":-0.5,"z":0},)"
              R"("rotation":{"x":0,"y":0,"z":0,"w":1}}}]})"),
          ContainsRegex("value /clock .\"clock\":.\"sec\":[0-9]+,\"nsec\":[0-9]+")));
}

INSTANTIATE_TEST_SUITE_P(Cyclone, FoxgloveNode, testing::Values("cyclone"));
#if RUNNEL_HAS_FAST
INSTANTIATE_TEST_SUITE_P(Fast, FoxgloveNode, testing::Values("fast"));
#endif

}  // namespace
}  // namespace runnel::test

#include "plugins/ros_messages/names.h"

#include <gmock/gmock.h>

namespace runnel::test {
namespace {

using testing::HasSubstr;

TEST(RosNames, AreCheckedWithACure) {
  for (const char* name : {"/scan", "/robot_1/laser/scan", "/_hidden", "/A9"}) {
    EXPECT_TRUE(CheckRosName(name)) << name;
  }
  const auto why_not = [](const std::string& name) {
    const auto checked = CheckRosName(name);
    return checked ? "it is a name" : checked.error().message + "; " + checked.error().hint;
  };
  EXPECT_EQ(why_not("scan"), "a name of ROS 2 begins with '/' and a word, unlike \"scan\"; write '/scan'");
  EXPECT_THAT(why_not(""), HasSubstr("write '/topic'"));
  EXPECT_THAT(why_not("/"), HasSubstr("write '/topic'"));
  EXPECT_THAT(why_not("/a//b"), HasSubstr("behind each '/', unlike \"/a//b\"; write '/a/b'"));
  EXPECT_THAT(why_not("/a/"), HasSubstr("write '/a'"));
  EXPECT_THAT(why_not("/laser 1/scän"), HasSubstr("write '/laser_1/sc__n'"));
  EXPECT_THAT(why_not("/a/1b"), HasSubstr("begins with a digit, unlike \"/a/1b\"; write '/a/_1b'"));
  EXPECT_THAT(why_not("/" + std::string(247, 'a')), HasSubstr("at most 247 characters"));
}

TEST(RosNames, OfAllKindsHaveAnAllowedNeighbour) {
  for (int c = 1; c < 256; ++c) {
    const std::string name = std::string("/a") + static_cast<char>(c) + "/b" + static_cast<char>(c);
    EXPECT_TRUE(CheckRosName(NearestRosName(name))) << c;
    EXPECT_TRUE(IsRosFieldName(NearestFieldName(name))) << c << " " << NearestFieldName(name);
    EXPECT_TRUE(IsRosMessageName(NearestMessageName(name))) << c << " " << NearestMessageName(name);
  }
  EXPECT_EQ(NearestFieldName("maxSpeed"), "max_speed");
  EXPECT_EQ(NearestFieldName("LED2On"), "led2_on");
  EXPECT_EQ(NearestFieldName("3d__pose_"), "f3d_pose");
  EXPECT_EQ(NearestMessageName("planning::path 2"), "PlanningPath2");
}

TEST(RosNames, BecomeThoseOfDds) {
  EXPECT_EQ(DdsTopic("/robot/scan"), "rt/robot/scan");
  EXPECT_EQ(DdsRequestTopic("/set"), "rq/setRequest");
  EXPECT_EQ(DdsReplyTopic("/set"), "rr/setReply");
  EXPECT_EQ(RosTopic("rt/robot/scan"), "/robot/scan");
  EXPECT_EQ(RosTopic("rq/setRequest"), "");
  EXPECT_EQ(RosTopic("rt/a b"), "");
  EXPECT_EQ(DdsType("sensor_msgs/msg/LaserScan"), "sensor_msgs::msg::dds_::LaserScan_");
  EXPECT_EQ(DdsType("rcl_interfaces/srv/GetParameters_Request"), "rcl_interfaces::srv::dds_::GetParameters_Request_");
  EXPECT_EQ(RosType("sensor_msgs::msg::dds_::LaserScan_"), "sensor_msgs/msg/LaserScan");
  EXPECT_EQ(RosType("Other"), "");
}

}  // namespace
}  // namespace runnel::test

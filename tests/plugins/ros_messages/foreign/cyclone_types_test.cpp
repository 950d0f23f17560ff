// Messages in the structures that Cyclone's compiler makes of ROS 2's definitions, read and written by Cyclone: what
// is written here is read there, and the other way round, octet by octet.
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <ros_messages.h>

#include "core/types/text_format.h"
#include "modules/types/drawing.h"
#include "modules/types/measurements.h"
#include "modules/types/pose.h"
#include "plugins/ros_messages/message_codec.h"
#include "plugins/ros_messages/message_library.h"
#include "plugins/ros_messages/names.h"
#include "tests/plugins/cdr_values/random_value.h"
#include "tests/plugins/ros_messages/foreign/cyclone_sample.h"
#include "tests/plugins/ros_messages/random_message.h"

namespace runnel::test {
namespace {

constexpr const dds_topic_descriptor_t* kTypes[] = {
#define RUNNEL_FOREIGN_TYPE(descriptor) &descriptor,
#include <ros_messages.inc>
#undef RUNNEL_FOREIGN_TYPE
};

constexpr Time kStamp = Time(std::chrono::seconds(1'790'000'000) + Duration(5));

const dds_topic_descriptor_t& TypeFor(const std::string& ros_type) {
  const std::string name = DdsType(ros_type);
  for (const auto* const each : kTypes) {
    if (each->m_typename == name) return *each;
  }
  throw std::runtime_error("no foreign type " + name);
}

TEST(CycloneTypes, AreThereForEachMessage) {
  for (const MessageDefinition* const each : MessageLibrary::Standard().All()) {
    const bool is_message = each->name.find("/msg/") != std::string::npos;
    if (is_message) {
      EXPECT_NO_THROW((void)TypeFor(each->name));
    }
  }
}

// Of all messages, those of ROS 2's own tests among them, which Runnel reads from their .msg files.
TEST(CycloneTypes, HaveTheOctetsOfOurDefinitions) {
  MessageLibrary library;
  const auto read = library.Read(RUNNEL_TEST_INTERFACE_FILES);
  ASSERT_TRUE(read) << read.error().ToString();
  RandomMessage random(5, library);
  for (const auto* const type : kTypes) {
    const auto* const definition = library.Find(RosType(type->m_typename));
    ASSERT_NE(definition, nullptr) << type->m_typename;
    for (int i = 0; i < 30; ++i) {
      const auto octets = random.Make(*definition);
      CycloneSample sample(*type);
      ASSERT_TRUE(sample.Read(octets)) << definition->name;
      ASSERT_EQ(sample.Write(), octets) << definition->name;
    }
  }
}

// Random values of one type as each message that fits.
template <typename T>
void CheckBothWays(const std::vector<std::string>& messages) {
  RandomValue random(9);
  for (const std::string& as : messages) {
    const auto made =
        MessageCodec::Make(TypeOf<T>(), {.as = as, .frame = "map", .child_frame = "robot"}, MessageLibrary::Standard());
    ASSERT_TRUE(made) << made.error().ToString();
    const MessageCodec& codec = **made;
    EXPECT_EQ(codec.dds_type(), TypeFor(as).m_typename);
    for (int i = 0; i < 20; ++i) {
      T value{}, back{};
      random.Fill(TypeOf<T>(), &value);
      std::vector<std::byte> octets;
      codec.Encode(&value, kStamp, octets);
      CycloneSample sample(TypeFor(as));
      ASSERT_TRUE(sample.Read(octets)) << as;
      const auto theirs = sample.Write();
      ASSERT_EQ(theirs, octets) << as;
      if (!codec.why_no_decoding().empty()) continue;
      const auto decoded = codec.Decode(theirs, &back);
      ASSERT_TRUE(decoded) << as << ": " << decoded.error().ToString();
      std::vector<std::byte> again;
      codec.Encode(&back, kStamp, again);
      // A heading has many turns, and the last angle of a scan is computed.
      const std::string& tag = TypeOf<T>().semantic_tag();
      const bool is_exact = tag != "pose" && tag != "range_scan";
      ASSERT_TRUE(!is_exact || again == octets) << as;
    }
  }
}

TEST(CycloneTypes, TakeAndGiveValuesOfRunnel) {
  CheckBothWays<Point2>({"geometry_msgs/msg/PointStamped", "geometry_msgs/msg/Point", "geometry_msgs/msg/Point32",
                         "geometry_msgs/msg/Vector3", "geometry_msgs/msg/Vector3Stamped"});
  CheckBothWays<Pose2>({"geometry_msgs/msg/PoseStamped", "geometry_msgs/msg/Pose", "geometry_msgs/msg/Pose2D",
                        "geometry_msgs/msg/PoseWithCovariance", "geometry_msgs/msg/PoseWithCovarianceStamped",
                        "geometry_msgs/msg/Transform", "geometry_msgs/msg/TransformStamped", "nav_msgs/msg/Odometry",
                        "tf2_msgs/msg/TFMessage"});
  CheckBothWays<Twist2>({"geometry_msgs/msg/Twist", "geometry_msgs/msg/TwistStamped",
                         "geometry_msgs/msg/TwistWithCovariance", "geometry_msgs/msg/TwistWithCovarianceStamped",
                         "nav_msgs/msg/Odometry"});
  CheckBothWays<RangeScan>({"sensor_msgs/msg/LaserScan"});
  CheckBothWays<Image>({"sensor_msgs/msg/Image"});
  CheckBothWays<Path2>({"nav_msgs/msg/Path", "geometry_msgs/msg/Polygon", "geometry_msgs/msg/PolygonStamped"});
  CheckBothWays<std::vector<Point2>>({"geometry_msgs/msg/PoseArray"});
  CheckBothWays<double>({"std_msgs/msg/Float64"});
  CheckBothWays<bool>({"std_msgs/msg/Bool"});
  CheckBothWays<std::string>({"std_msgs/msg/String"});
  CheckBothWays<Time>({"rosgraph_msgs/msg/Clock", "builtin_interfaces/msg/Time"});
  CheckBothWays<std::vector<double>>({"std_msgs/msg/Float64MultiArray"});
}

TEST(CycloneTypes, HaveEachPartInItsPlace) {
  const auto encoded = [](const auto& value, const MessageOptions& options) {
    using T = std::remove_cvref_t<decltype(value)>;
    std::vector<std::byte> octets;
    (*MessageCodec::Make(TypeOf<T>(), options, MessageLibrary::Standard()))->Encode(&value, kStamp, octets);
    return octets;
  };
  CycloneSample scan(sensor_msgs_msg_dds__LaserScan__desc);
  const RangeScan seen{
      .start_angle = -1, .angle_step = 0.5, .range_minimum = 0.125, .range_maximum = 8, .ranges = {1, 2, 3}};
  ASSERT_TRUE(scan.Read(encoded(seen, {.frame = "laser"})));
  const auto& their_scan = scan.as<sensor_msgs_msg_dds__LaserScan_>();
  EXPECT_EQ(their_scan.header.stamp.sec, 1'790'000'000);
  EXPECT_EQ(their_scan.header.stamp.nanosec, 5U);
  EXPECT_STREQ(their_scan.header.frame_id, "laser");
  EXPECT_EQ(their_scan.angle_min, -1);
  EXPECT_EQ(their_scan.angle_max, 0);
  EXPECT_EQ(their_scan.angle_increment, 0.5);
  EXPECT_EQ(their_scan.range_min, 0.125);
  EXPECT_EQ(their_scan.range_max, 8);
  ASSERT_EQ(their_scan.ranges._length, 3U);
  EXPECT_EQ(their_scan.ranges._buffer[2], 3);
  EXPECT_EQ(their_scan.intensities._length, 0U);

  CycloneSample odometry(nav_msgs_msg_dds__Odometry__desc);
  ASSERT_TRUE(odometry.Read(encoded(Pose2{1, 2, 3.14159265358979323846},
                                    {.as = "nav_msgs/msg/Odometry", .frame = "odom", .child_frame = "robot"})));
  const auto& their_odometry = odometry.as<nav_msgs_msg_dds__Odometry_>();
  EXPECT_STREQ(their_odometry.child_frame_id, "robot");
  EXPECT_EQ(their_odometry.pose.pose.position.y, 2);
  EXPECT_NEAR(their_odometry.pose.pose.orientation.z, 1, 1e-12);
  EXPECT_NEAR(their_odometry.pose.pose.orientation.w, 0, 1e-12);

  CycloneSample path(nav_msgs_msg_dds__Path__desc);
  ASSERT_TRUE(path.Read(encoded(Path2{{{1, 2}, {3, 4}}}, {.frame = "map"})));
  const auto& their_path = path.as<nav_msgs_msg_dds__Path_>();
  ASSERT_EQ(their_path.poses._length, 2U);
  EXPECT_STREQ(their_path.poses._buffer[1].header.frame_id, "map");
  EXPECT_EQ(their_path.poses._buffer[1].pose.position.x, 3);
  EXPECT_EQ(their_path.poses._buffer[1].pose.orientation.w, 1) << "the message's default";
}

// Walls round 2 m by 1 m, in which an obstacle of 0.5 m has a hole.
TEST(CycloneTypes, HaveGroundPlansAsGrids) {
  WorldMap map;
  map.bounds = {{0, 0}, {2, 0}, {2, 1}, {0, 1}};
  map.outlines.push_back({.points = {{1, 0.25}, {1.5, 0.25}, {1.5, 0.75}, {1, 0.75}}});
  map.outlines.push_back({.points = {{1.125, 0.375}, {1.375, 0.375}, {1.375, 0.625}, {1.125, 0.625}}, .is_hole = true});
  const auto codec = *MessageCodec::Make(TypeOf<WorldMap>(), {.frame = "map"}, MessageLibrary::Standard());
  std::vector<std::byte> octets;
  codec->Encode(&map, kStamp, octets);
  CycloneSample sample(nav_msgs_msg_dds__OccupancyGrid__desc);
  ASSERT_TRUE(sample.Read(octets));
  const auto& grid = sample.as<nav_msgs_msg_dds__OccupancyGrid_>();
  EXPECT_STREQ(grid.header.frame_id, "map");
  EXPECT_FLOAT_EQ(grid.info.resolution, 0.05F);
  EXPECT_EQ(grid.info.width, 41U);
  EXPECT_EQ(grid.info.height, 21U);
  EXPECT_EQ(grid.info.origin.orientation.w, 1);
  ASSERT_EQ(grid.data._length, 41U * 21U);
  const auto at = [&](double x, double y) {
    return static_cast<int>(
        grid.data._buffer[static_cast<std::size_t>(y / 0.05) * 41 + static_cast<std::size_t>(x / 0.05)]);
  };
  EXPECT_EQ(at(0.51, 0.51), 0);
  EXPECT_EQ(at(1.08, 0.51), 100) << "within the obstacle";
  EXPECT_EQ(at(1.26, 0.51), 0) << "within its hole";
  EXPECT_EQ(at(0.01, 0.51), 100) << "the wall";

  codec->Encode(&(map = {}), kStamp, octets);
  CycloneSample empty(nav_msgs_msg_dds__OccupancyGrid__desc);
  EXPECT_TRUE(empty.Read(octets));
  map.bounds = {{0, 0}, {1000, 0}, {1000, 500}};
  codec->Encode(&map, kStamp, octets);
  EXPECT_LT(octets.size(), 2100000U) << "large worlds have large cells";
  map.bounds = {{-1e300, NAN}, {1e300, -INFINITY}, {0, INFINITY}};
  codec->Encode(&map, kStamp, octets);
  EXPECT_LT(octets.size(), 4100000U) << "large worlds have large cells";
}

}  // namespace
}  // namespace runnel::test

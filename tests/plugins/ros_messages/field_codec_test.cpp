// One field of a message, read by itself, against the whole message.
#include <random>

#include <diagnostic_msgs/diagnostic_array.h>
#include <gmock/gmock.h>
#include <nav_msgs/odometry.h>
#include <sensor_msgs/battery_state.h>
#include <sensor_msgs/camera_info.h>
#include <sensor_msgs/point_cloud2.h>
#include <visualization_msgs/marker.h>

#include "core/conversion/value_part.h"
#include "modules/types/pose.h"
#include "plugins/cdr_values/cdr_values.h"
#include "plugins/ros_messages/message_codec.h"
#include "plugins/testing/guards.h"
#include "tests/plugins/ros_messages/random_message.h"

namespace runnel::test {
namespace {

using testing::HasSubstr;

using Octets = std::vector<std::byte>;

Octets OctetsOf(const TypeInfo& type, const void* value) {
  Octets octets;
  WriteCdr(type, value, octets);
  return octets;
}

std::string WhyNot(const TypeInfo& type, const std::string& as, const std::string& field) {
  const auto made = MessageCodec::Make(type, {.as = as, .field = field}, MessageLibrary::Standard());
  if (!made) return made.error().ToString();
  return "it could be made";
}

std::string Problem(const MessageCodec& codec, const Octets& octets, void* value) {
  const auto read = codec.Decode(octets, value);
  if (!read) return read.error().message;
  return "";
}

// Each part of the type that is the message, once as part of all and once alone. Returns how many were there.
template <typename T>
std::size_t CheckFields(const std::string& as) {
  const MessageLibrary& library = MessageLibrary::Standard();
  const MessageDefinition& definition = **library.Get(as);
  std::size_t compared = 0;
  ForEachPart(TypeOf<T>(), [&](const std::string& name, const TypeInfo& type, const std::string& /*unit*/) {
    const auto codec = MessageCodec::Make(type, {.as = as, .field = name}, library);
    ASSERT_TRUE(codec) << name << ": " << codec.error().ToString();
    EXPECT_EQ((*codec)->ros_type(), as);
    EXPECT_EQ((*codec)->type_hash(), TypeHashOf(definition, library));
    const auto part = *ValuePart::In(TypeOf<T>(), name);
    RandomMessage random(31, library);
    for (int i = 0; i < 20; ++i) {
      const auto octets = random.Make(definition);
      T whole{};
      ASSERT_TRUE(ReadCdr(TypeOf<T>(), octets, &whole));
      const auto alone = type.Make();
      const std::string problem = Problem(**codec, octets, alone.get());
      const void* const expected = part.Find(&whole);
      if (expected == nullptr) {
        ASSERT_THAT(problem, HasSubstr("it has no element [0], but 0 of them")) << name;
        continue;
      }
      ASSERT_EQ(problem, "") << name;
      ASSERT_TRUE(OctetsOf(type, alone.get()) == OctetsOf(type, expected)) << name;
      ++compared;
    }
  });
  return compared;
}

TEST(FieldCodec, ReadsWhatTheWholeMessageHasThere) {
  EXPECT_GT(CheckFields<sensor_msgs::BatteryState>("sensor_msgs/msg/BatteryState"), 200U);
  EXPECT_GT(CheckFields<nav_msgs::Odometry>("nav_msgs/msg/Odometry"), 200U);
  EXPECT_GT(CheckFields<sensor_msgs::CameraInfo>("sensor_msgs/msg/CameraInfo"), 200U);
  EXPECT_GT(CheckFields<sensor_msgs::PointCloud2>("sensor_msgs/msg/PointCloud2"), 200U);
  EXPECT_GT(CheckFields<diagnostic_msgs::DiagnosticArray>("diagnostic_msgs/msg/DiagnosticArray"), 50U);
  EXPECT_GT(CheckFields<visualization_msgs::Marker>("visualization_msgs/msg/Marker"), 200U);
}

TEST(FieldCodec, ConvertsAsWholeMessagesDo) {
  nav_msgs::Odometry odometry;
  odometry.header.frame_id = "odom";
  odometry.pose.pose.position.x = 1.5;
  odometry.pose.pose.position.y = 2;
  odometry.pose.pose.orientation.z = 1;
  odometry.pose.pose.orientation.w = 0;
  odometry.pose.covariance[35] = 7;
  const Octets octets = OctetsOf(TypeOf<nav_msgs::Odometry>(), &odometry);
  const auto read = [&]<typename T>(const std::string& field, T value) {
    const auto codec =
        MessageCodec::Make(TypeOf<T>(), {.as = "nav_msgs/Odometry", .field = field}, MessageLibrary::Standard());
    EXPECT_TRUE(codec) << (codec ? "" : codec.error().ToString());
    EXPECT_EQ(codec ? Problem(**codec, octets, &value) : "none", "");
    return value;
  };
  EXPECT_EQ(read("pose.pose.position.x", float{}), 1.5F);
  EXPECT_EQ(read("pose.covariance[35]", int{}), 7);
  EXPECT_EQ(read("header.frame_id", std::string()), "odom");
  const Pose2 pose = read("pose.pose", Pose2());
  EXPECT_EQ(pose.x, 1.5);
  EXPECT_NEAR(pose.heading, 3.1415926, 1e-6);
  EXPECT_EQ(read("pose.covariance", std::vector<float>())[35], 7);
}

TEST(FieldCodec, ALaterElementIsFoundBehindOnesOfAnyLength) {
  diagnostic_msgs::DiagnosticArray array;
  array.status.resize(3);
  for (std::size_t i = 0; i < 3; ++i) {
    array.status[i].name = std::string(5 * i + 1, 'n');
    array.status[i].values.resize(i + 1);
    array.status[i].values[i].value = std::to_string(i);
  }
  const Octets octets = OctetsOf(TypeOf<diagnostic_msgs::DiagnosticArray>(), &array);
  const auto codec = [](const std::string& field) {
    return *MessageCodec::Make(TypeOf<std::string>(), {.as = "diagnostic_msgs/msg/DiagnosticArray", .field = field},
                               MessageLibrary::Standard());
  };
  std::string value;
  EXPECT_EQ(Problem(*codec("status[2].values[2].value"), octets, &value), "");
  EXPECT_EQ(value, "2");
  EXPECT_EQ(Problem(*codec("status[3].name"), octets, &value), "status: it has no element [3], but 3 of them");
  EXPECT_EQ(Problem(*codec("status[1].values[2].value"), octets, &value),
            "status.values: it has no element [2], but 2 of them");
  EXPECT_EQ(value, "2") << "nothing has been read";
}

TEST(FieldCodec, TellsWhatIsNotThere) {
  const TypeInfo& number = TypeOf<double>();
  const std::string battery = "sensor_msgs/msg/BatteryState";
  EXPECT_EQ(WhyNot(number, battery, "percentag"),
            "sensor_msgs/msg/BatteryState has no field 'percentag'; did you mean 'percentage'?");
  EXPECT_THAT(WhyNot(number, "nav_msgs/msg/Odometry", "pose.pose.positon.x"),
              HasSubstr("geometry_msgs/msg/Pose has no field 'positon'; did you mean 'position'?"));
  EXPECT_THAT(WhyNot(number, "nav_msgs/msg/Odometry", "pose.covariance[36]"),
              HasSubstr("'covariance' has no element [36]; it has 36, counted from 0"));
  EXPECT_THAT(WhyNot(number, "nav_msgs/msg/Odometry", "pose.pose.position"),
              HasSubstr("a double is no geometry_msgs/msg/Point; say which of its fields: pose.pose.position.x "
                        "pose.pose.position.y"));
  EXPECT_THAT(WhyNot(number, battery, "cell_voltage"),
              HasSubstr("a double is no float32[]; of its elements, the first is cell_voltage[0]"));
  EXPECT_THAT(WhyNot(number, battery, "cell_voltage[x]"),
              HasSubstr("'[x]' names no element; write [INDEX], counted from 0"));
  EXPECT_THAT(WhyNot(number, battery, "cell_voltage[-1]"), HasSubstr("names no element"));
  EXPECT_THAT(WhyNot(number, battery, "cell_voltage[1"), HasSubstr("names no element"));
  EXPECT_THAT(WhyNot(number, battery, "voltage[0]"), HasSubstr("'voltage' has no elements"));
  EXPECT_THAT(WhyNot(number, battery, "voltage.x"), HasSubstr("'voltage' has no fields"));
  EXPECT_THAT(WhyNot(number, "diagnostic_msgs/msg/DiagnosticArray", "status.level"),
              HasSubstr("'status' is a list; say which of its elements: status[0].level"));
  EXPECT_THAT(WhyNot(number, battery, "location"), HasSubstr("a double is no string"));
  EXPECT_THAT(WhyNot(number, battery, "."), HasSubstr("has no field ''"));
  EXPECT_THAT(WhyNot(number, "", "percentage"),
              HasSubstr("nobody says of which; say it: as=\"sensor_msgs/msg/BatteryState\""));
}

TEST(FieldCodec, SurvivesAnyOctets) {
  std::mt19937 random(13);
  const MessageLibrary& library = MessageLibrary::Standard();
  const auto check = [&]<typename T>(const std::string& as, const std::string& field, T value) {
    const auto codec = *MessageCodec::Make(TypeOf<T>(), {.as = as, .field = field}, library);
    RandomMessage messages(17, library);
    for (int i = 0; i < 2000; ++i) {
      Octets octets = messages.Make(**library.Get(as));
      for (int change = 0; change < 3; ++change) {
        octets[random() % octets.size()] = static_cast<std::byte>(random() % 3 == 0 ? 255 : random());
      }
      if (random() % 3 == 0) octets.resize(random() % octets.size());
      const Octets exact(octets);  // so that what is beyond its end is nobody's
      (void)codec->Decode(exact, &value);
    }
  };
  check("sensor_msgs/msg/BatteryState", "cell_temperature[2]", double{});
  check("sensor_msgs/msg/BatteryState", "serial_number", std::string());
  check("diagnostic_msgs/msg/DiagnosticArray", "status[1].values[1].value", std::string());
  check("visualization_msgs/msg/Marker", "points[1]", Pose2());
  check("sensor_msgs/msg/PointCloud2", "data", std::vector<std::uint8_t>());
}

// What claims to be long is held against what is there before anything is made of it, or passed over.
TEST(FieldCodec, BelievesNoLength) {
  const auto codec = *MessageCodec::Make(
      TypeOf<double>(), {.as = "diagnostic_msgs/msg/DiagnosticArray", .field = "status[4000000000].level"},
      MessageLibrary::Standard());
  Octets octets;
  CdrWriter writer(octets);
  writer.Put(std::int32_t{1});
  writer.Put(std::uint32_t{1});
  writer.PutText("frame");
  const Octets before = octets;
  writer.PutCount(4'294'967'295U);
  double value = 5;
  const AllocationGuard guard;
  const bool is_read = codec->Decode(octets, &value).has_value();
  EXPECT_LT(guard.allocations(), 20U) << "for the words of the error";
  EXPECT_FALSE(is_read);
  EXPECT_EQ(Problem(*codec, octets, &value), "status: it claims more elements than there are octets for");
  EXPECT_EQ(Problem(*codec, before, &value), "status: it claims more elements than there are octets for");
  EXPECT_EQ(value, 5);
}

TEST(FieldCodec, AllocatesNothing) {
  sensor_msgs::BatteryState state;
  state.header.frame_id = "a frame of more than fifteen letters";
  state.cell_voltage = {1, 2, 3};
  const Octets octets = OctetsOf(TypeOf<sensor_msgs::BatteryState>(), &state);
  const auto codec = *MessageCodec::Make(
      TypeOf<double>(), {.as = "sensor_msgs/msg/BatteryState", .field = "cell_voltage[2]"}, MessageLibrary::Standard());
  double value = 0;
  const AllocationGuard guard;
  const bool is_read = codec->Decode(octets, &value).has_value();
  EXPECT_EQ(guard.allocations(), 0U);
  EXPECT_TRUE(is_read);
  EXPECT_EQ(value, 3);
}

}  // namespace
}  // namespace runnel::test

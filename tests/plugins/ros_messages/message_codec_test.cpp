#include "plugins/ros_messages/message_codec.h"

#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include <gmock/gmock.h>

#include "core/types/builtin_types.h"
#include "core/types/text_format.h"
#include "modules/types/drawing.h"
#include "modules/types/measurements.h"
#include "modules/types/planner_status.h"
#include "modules/types/pose.h"
#include "plugins/cdr_values/cdr_values.h"
#include "plugins/ros_messages/message_library.h"
#include "plugins/testing/guards.h"
#include "tests/plugins/cdr_values/random_value.h"

namespace example {

/// As sensor_msgs/Range was in Humble, without its last field.
struct OldRange {
  std::uint8_t radiation_type = 0;
  float field_of_view = 0, range = 0;
};
struct NewRange : OldRange {
  float variance = -1;
};
inline void Describe(runnel::TypeBuilder<OldRange>& type) {
  type.Name("OldRange").Field("radiation_type", &OldRange::radiation_type).Field("range", &OldRange::range);
}
inline void Describe(runnel::TypeBuilder<NewRange>& type) {
  type.Name("NewRange").Field("range", &NewRange::range).Field("variance", &NewRange::variance);
}

struct Velocity {
  std::array<float, 2> covariance{};
  std::string linear;
};
inline void Describe(runnel::TypeBuilder<Velocity>& type) {
  type.Name("Velocity").Field("covariance", &Velocity::covariance).Field("linear", &Velocity::linear);
}

struct Joints {
  std::vector<std::string> name;
  std::vector<float> position;
  int tick = 0;
};
inline void Describe(runnel::TypeBuilder<Joints>& type) {
  type.Name("Joints").Field("name", &Joints::name).Field("position", &Joints::position).Field("tick", &Joints::tick);
}

}  // namespace example

namespace runnel::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

using Octets = std::vector<std::byte>;
using Codec = std::shared_ptr<const MessageCodec>;

constexpr Time kStamp = Time(std::chrono::seconds(1'790'000'000) + Duration(5));

template <typename T>
Codec CodecOf(const MessageOptions& options = {}) {
  auto made = MessageCodec::Make(TypeOf<T>(), options, MessageLibrary::Standard());
  EXPECT_TRUE(made) << (made ? "" : made.error().ToString());
  return made ? *made : nullptr;
}

template <typename T>
std::string WhyNot(const MessageOptions& options) {
  const auto made = MessageCodec::Make(TypeOf<T>(), options, MessageLibrary::Standard());
  return made ? "it could be made" : made.error().ToString();
}

template <typename T>
Octets Encoded(const T& value, const MessageOptions& options = {}) {
  Octets octets;
  CodecOf<T>(options)->Encode(&value, kStamp, octets);
  return octets;
}

template <typename T>
T Decoded(const Octets& octets, const MessageOptions& options = {}) {
  T value{};
  const auto decoded = CodecOf<T>(options)->Decode(octets, &value);
  EXPECT_TRUE(decoded) << (decoded ? "" : decoded.error().ToString());
  return value;
}

TEST(MessageCodec, NamesWhatFitsTheMeaning) {
  EXPECT_EQ(CodecOf<RangeScan>()->ros_type(), "sensor_msgs/msg/LaserScan");
  EXPECT_EQ(CodecOf<RangeScan>()->dds_type(), "sensor_msgs::msg::dds_::LaserScan_");
  EXPECT_THAT(CodecOf<RangeScan>()->type_hash(), testing::StartsWith("RIHS01_64c19139"));
  EXPECT_EQ(CodecOf<Pose2>()->ros_type(), "geometry_msgs/msg/PoseStamped");
  EXPECT_EQ(CodecOf<Twist2>()->ros_type(), "geometry_msgs/msg/Twist");
  EXPECT_EQ(CodecOf<Point2>()->ros_type(), "geometry_msgs/msg/PointStamped");
  EXPECT_EQ(CodecOf<Image>()->ros_type(), "sensor_msgs/msg/Image");
  EXPECT_EQ(CodecOf<Path2>()->ros_type(), "nav_msgs/msg/Path");
  EXPECT_EQ(CodecOf<double>()->ros_type(), "std_msgs/msg/Float64");
  EXPECT_EQ(CodecOf<std::string>()->ros_type(), "std_msgs/msg/String");
  EXPECT_EQ(CodecOf<Signal>()->ros_type(), "std_msgs/msg/Empty");
  EXPECT_EQ(CodecOf<Time>()->ros_type(), "builtin_interfaces/msg/Time");
  EXPECT_EQ(CodecOf<std::vector<float>>()->ros_type(), "std_msgs/msg/Float32MultiArray");
  EXPECT_EQ(CodecOf<PlannerStatus>()->ros_type(), "runnel_msgs/msg/PlannerStatus");
  EXPECT_EQ(CodecOf<RangeScan>({.by_description = true})->ros_type(), "runnel_msgs/msg/RangeScan");
}

// What comes back is what went out, in each message that has room for all of it.
TEST(MessageCodec, BringsBackWhatItHasWritten) {
  RandomValue random(3);
  const auto check = [&]<typename T>(std::type_identity<T>, const MessageOptions& options) {
    for (int i = 0; i < 50; ++i) {
      T value{};
      random.Fill(TypeOf<T>(), &value);
      EXPECT_EQ(TextOf(Decoded<T>(Encoded(value, options), options)), TextOf(value)) << options.as;
    }
  };
  check(std::type_identity<Twist2>(), {});
  check(std::type_identity<Twist2>(), {.as = "geometry_msgs/msg/TwistStamped"});
  check(std::type_identity<Twist2>(), {.as = "nav_msgs/msg/Odometry"});
  check(std::type_identity<Point2>(), {});
  check(std::type_identity<Point2>(), {.as = "geometry_msgs/msg/Vector3"});
  check(std::type_identity<Path2>(), {});
  check(std::type_identity<std::vector<Point2>>(), {.as = "geometry_msgs/msg/PoseArray"});
  check(std::type_identity<Image>(), {});
  check(std::type_identity<double>(), {});
  check(std::type_identity<bool>(), {});
  check(std::type_identity<Signal>(), {});
  check(std::type_identity<std::vector<double>>(), {});
  check(std::type_identity<PlannerStatus>(), {});
  check(std::type_identity<WorldMap>(), {.by_description = true});
  check(std::type_identity<float>(), {.as = "std_msgs/msg/Float64"});
  check(std::type_identity<Time>(), {.as = "rosgraph_msgs/msg/Clock"});
}

TEST(MessageCodec, TurnsHeadingsIntoQuaternions) {
  for (const char* as : {"geometry_msgs/msg/Pose", "geometry_msgs/msg/PoseStamped", "geometry_msgs/msg/Transform",
                         "geometry_msgs/msg/PoseWithCovarianceStamped", "geometry_msgs/msg/TransformStamped",
                         "nav_msgs/msg/Odometry", "geometry_msgs/msg/Pose2D"}) {
    for (const double heading : {0.0, 0.5, -3.0, 3.14}) {
      const auto back = Decoded<Pose2>(Encoded(Pose2{1, -2, heading}, {.as = as}), {.as = as});
      EXPECT_EQ(back.x, 1) << as;
      EXPECT_EQ(back.y, -2) << as;
      EXPECT_NEAR(back.heading, heading, 1e-12) << as;
    }
  }
}

// As tf2::getYaw has it.
TEST(MessageCodec, ReadsHeadingsOfQuaternionsOfAnyLengthButZero) {
  const auto codec = CodecOf<Pose2>({.as = "geometry_msgs/msg/Pose"});
  const auto with = [](double x, double y, double z, double w) {
    Octets octets;
    CdrWriter to(octets);
    for (const double each : {1.0, -2.0, 0.0, x, y, z, w}) to.Put(each);
    return octets;
  };
  Pose2 pose;
  for (const double length : {0.5, 1.0, 20.0}) {
    ASSERT_TRUE(codec->Decode(with(0, 0, length, length), &pose));
    EXPECT_NEAR(pose.heading, std::numbers::pi / 2, 1e-12) << length;
  }
  for (const double each : {0.0, std::nan(""), double{INFINITY}}) {
    const auto refused = codec->Decode(with(0, 0, each, 0), &pose);
    ASSERT_FALSE(refused) << each;
    EXPECT_THAT(refused.error().message, HasSubstr("has no heading"));
  }
}

TEST(MessageCodec, PutsStampAndFrameIntoHeaders) {
  const Octets octets = Encoded(Pose2{}, {.frame = "map"});
  auto reader = CdrReader::Begin(octets);
  std::int32_t seconds = 0, nanoseconds = 0;
  std::string frame;
  ASSERT_TRUE(reader->Get(seconds) && reader->Get(nanoseconds) && reader->GetText(frame));
  EXPECT_EQ(seconds, 1'790'000'000);
  EXPECT_EQ(nanoseconds, 5);
  EXPECT_EQ(frame, "map");
  Pose2 pose;
  EXPECT_EQ(CodecOf<Pose2>()->Decode(octets, &pose)->stamp, kStamp);
  Twist2 twist;
  EXPECT_EQ(CodecOf<Twist2>()->Decode(Encoded(twist), &twist)->stamp, std::nullopt);
}

TEST(MessageCodec, ScansEndAtTheirLastRay) {
  RangeScan scan{
      .start_angle = -1, .angle_step = 0.5, .range_minimum = 0.1, .range_maximum = 8, .ranges = {1, 2, INFINITY}};
  const Octets octets = Encoded(scan);
  float last = 0;
  auto reader = CdrReader::Begin(octets);
  ASSERT_TRUE(reader->Skip(4, 2) && reader->Skip(4, 1) && reader->Skip(1, 1) && reader->Skip(4, 1) &&
              reader->Get(last));
  EXPECT_EQ(last, 0.0F);
  const auto back = Decoded<RangeScan>(octets);
  EXPECT_EQ(back.ranges, scan.ranges);
  EXPECT_FLOAT_EQ(static_cast<float>(back.range_minimum), 0.1F);
}

TEST(MessageCodec, TellsWhatDoesNotFit) {
  EXPECT_THAT(WhyNot<RangeScan>({.as = "sensor_msgs/msg/LaserScam"}),
              HasSubstr("did you mean 'sensor_msgs/msg/LaserScan'?"));
  EXPECT_EQ(WhyNot<Pose2>({.as = "sensor_msgs/msg/LaserScan"}),
            "a Pose2 has nothing of a sensor_msgs/msg/LaserScan; what fits is geometry_msgs/msg/PoseStamped");
  EXPECT_THAT(WhyNot<example::Velocity>({.as = "geometry_msgs/msg/Twist"}),
              HasSubstr("linear: a string is no geometry_msgs/msg/Vector3"));
  EXPECT_THAT(WhyNot<example::Velocity>({.as = "geometry_msgs/msg/TwistWithCovariance"}),
              HasSubstr("covariance: a float[2] is no float64[36]"));
  EXPECT_THAT(CodecOf<Pose2>({.as = "tf2_msgs/msg/TFMessage"})->why_no_decoding(),
              HasSubstr("any number of transforms"));
}

TEST(MessageCodec, BindsFieldsOfTheSameName) {
  const auto codec = CodecOf<example::Joints>({.as = "sensor_msgs/msg/JointState"});
  EXPECT_THAT(codec->left_out(), ElementsAre("tick"));
  example::Joints joints{{"a", "b"}, {1.5F, 2}, 7}, back;
  Octets octets;
  codec->Encode(&joints, kStamp, octets);
  ASSERT_TRUE(codec->Decode(octets, &back));
  EXPECT_EQ(back.name, joints.name);
  EXPECT_EQ(back.position, joints.position);
}

TEST(MessageCodec, ReadsMessagesOfEarlierVersions) {
  MessageLibrary humble;
  ASSERT_TRUE(humble.Add(*ParseMessage("uint8 radiation_type\nfloat32 range", "old/msg/Range", "")));
  ASSERT_TRUE(humble.Add(*ParseMessage("uint8 radiation_type\nfloat32 range\nfloat32 variance", "new/msg/Range", "")));
  const auto before = *MessageCodec::Make(TypeOf<example::OldRange>(), {.as = "old/msg/Range"}, humble);
  const auto after = *MessageCodec::Make(TypeOf<example::NewRange>(), {.as = "new/msg/Range"}, humble);
  example::OldRange old;
  old.range = 3;
  example::NewRange read;
  read.variance = 7;
  Octets octets;
  before->Encode(&old, kStamp, octets);
  ASSERT_TRUE(after->Decode(octets, &read));
  EXPECT_EQ(read.range, 3);
  EXPECT_EQ(read.variance, -1) << "as the type has it";
}

TEST(MessageCodec, SurvivesAnyOctets) {
  std::mt19937 random(11);
  const auto check = [&]<typename T>(std::type_identity<T>, const T& value, const MessageOptions& options) {
    const Codec codec = CodecOf<T>(options);
    Octets whole;
    codec->Encode(&value, kStamp, whole);
    T read{};
    for (int i = 0; i < 3000; ++i) {
      Octets octets = whole;
      for (int change = 0; change < 3; ++change) {
        octets[random() % octets.size()] = static_cast<std::byte>(random() % 3 == 0 ? 255 : random());
      }
      if (random() % 3 == 0) octets.resize(random() % octets.size());
      (void)codec->Decode(octets, &read);
    }
  };
  check(std::type_identity<RangeScan>(), {.ranges = {1, 2, 3}}, {.frame = "laser"});
  check(std::type_identity<Path2>(), {{{1, 2}, {3, 4}}}, {.frame = "map"});
  check(std::type_identity<Pose2>(), {1, 2, 3}, {.as = "nav_msgs/msg/Odometry"});
  check(std::type_identity<Pose2>(), {1, 2, 3}, {.as = "geometry_msgs/msg/PoseWithCovarianceStamped"});
  check(std::type_identity<PlannerStatus>(), {}, {});
  check(std::type_identity<std::vector<double>>(), {1, 2}, {});
}

TEST(MessageCodec, AllocatesNothingOnceMemoryIsThere) {
  RangeScan scan{.ranges = std::vector<float>(720, 1.0F)};
  const Codec codec = CodecOf<RangeScan>({.frame = "a frame of more than fifteen letters"});
  Octets octets;
  codec->Encode(&scan, kStamp, octets);
  const AllocationGuard guard;
  codec->Encode(&scan, kStamp, octets);
  const bool is_read = codec->Decode(octets, &scan).has_value();
  EXPECT_EQ(guard.allocations(), 0U);
  EXPECT_TRUE(is_read);
}

}  // namespace
}  // namespace runnel::test

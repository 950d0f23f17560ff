#include "plugins/ros_messages/node_messages.h"

#include <gmock/gmock.h>

#include "core/element/runtime.h"
#include "core/log/log_sink.h"
#include "plugins/cdr_values/cdr_values.h"
#include "plugins/parameters/parameter.h"
#include "plugins/ros_messages/message_codec.h"
#include "plugins/ros_messages/message_library.h"
#include "plugins/ros_messages/parameter_messages.h"
#include "tests/plugins/cdr_values/random_value.h"

namespace runnel::test {
namespace {

using Octets = std::vector<std::byte>;

// Each structure has all fields of its message and no other, and the octets of both are the same.
template <typename T>
void CheckSameAs(const std::string& message) {
  const auto made = MessageCodec::Make(TypeOf<T>(), {.as = message}, MessageLibrary::Standard());
  ASSERT_TRUE(made) << made.error().ToString();
  EXPECT_THAT((*made)->left_out(), testing::IsEmpty());
  RandomValue random(13);
  for (int i = 0; i < 20; ++i) {
    T value{}, back{};
    random.Fill(TypeOf<T>(), &value);
    // By the message, bools are 0 or 1 and bounded lists are cut.
    Octets by_message, by_description;
    (*made)->Encode(&value, {}, by_message);
    ASSERT_TRUE((*made)->Decode(by_message, &back)) << message;
    WriteCdr(TypeOf<T>(), &back, by_description);
    ASSERT_TRUE(by_message == by_description) << message;
  }
}

TEST(NodeMessages, AreThoseOfRos2) {
  CheckSameAs<RosLog>("rcl_interfaces/msg/Log");
  CheckSameAs<RosDiagnostics>("diagnostic_msgs/msg/DiagnosticArray");
  CheckSameAs<RosParameterValue>("rcl_interfaces/msg/ParameterValue");
  CheckSameAs<RosParameter>("rcl_interfaces/msg/Parameter");
  CheckSameAs<RosParameterDescriptor>("rcl_interfaces/msg/ParameterDescriptor");
  CheckSameAs<RosParameterEvent>("rcl_interfaces/msg/ParameterEvent");
  CheckSameAs<std::vector<std::string>>("rcl_interfaces/srv/GetParameters_Request");
  CheckSameAs<std::vector<std::string>>("rcl_interfaces/srv/GetParameterTypes_Request");
  CheckSameAs<std::vector<std::string>>("rcl_interfaces/srv/DescribeParameters_Request");
  CheckSameAs<std::vector<RosParameterValue>>("rcl_interfaces/srv/GetParameters_Response");
  CheckSameAs<std::vector<RosParameterType>>("rcl_interfaces/srv/GetParameterTypes_Response");
  CheckSameAs<std::vector<RosParameterDescriptor>>("rcl_interfaces/srv/DescribeParameters_Response");
  CheckSameAs<RosListRequest>("rcl_interfaces/srv/ListParameters_Request");
  CheckSameAs<RosListReply>("rcl_interfaces/msg/ListParametersResult");
  CheckSameAs<std::vector<RosParameter>>("rcl_interfaces/srv/SetParameters_Request");
  CheckSameAs<std::vector<RosSetResult>>("rcl_interfaces/srv/SetParameters_Response");
  CheckSameAs<RosSetResult>("rcl_interfaces/msg/SetParametersResult");
}

TEST(NodeMessages, SayWhatModulesSay) {
  const LogMessage said{.level = LogLevel::kWarning, .path = "/robot/sonar", .text = "no echo", .left_out = 3};
  const RosLog log = ToRosLog(said, Time(Duration(7)));
  EXPECT_EQ(log.level, 30);
  EXPECT_EQ(log.name, "robot.sonar");
  EXPECT_EQ(log.msg, "no echo (3 more left out)");
  EXPECT_EQ(log.stamp, Time(Duration(7)));
}

TEST(RosParameters, AreValuesOfAnyType) {
  const auto shown = [](const auto& value) {
    using T = std::remove_cvref_t<decltype(value)>;
    const RosParameterValue as_parameter = ToRosParameter(TypeOf<T>(), &value);
    return TextOf(as_parameter.type) + " " + *TextOf(as_parameter, TypeOf<T>());
  };
  EXPECT_EQ(shown(true), "bool true");
  EXPECT_EQ(shown(-3), "integer -3");
  EXPECT_EQ(shown(0.25), "double 0.25");
  EXPECT_EQ(shown(std::string("a b")), "string a b");
  EXPECT_EQ(shown(std::uint64_t{1} << 63), "string 9223372036854775808");
  EXPECT_EQ(shown(Duration(20'000'000)), "string 20ms");
  EXPECT_EQ(shown(std::vector<float>{1, 2.5}), "double_array [1, 2.5]");
  EXPECT_EQ(shown(std::vector<std::int16_t>{1, -2}), "integer_array [1, -2]");
  EXPECT_EQ(shown(std::vector<std::uint8_t>{1, 2}), "byte_array [1, 2]");
  EXPECT_EQ(shown(std::array<bool, 2>{true, false}), "bool_array [true, false]");
  EXPECT_EQ(shown(std::vector<std::string>{"a b", "c"}), R"(string_array ["a b", "c"])");
  EXPECT_EQ(shown(std::vector<std::uint64_t>{~std::uint64_t{0}}), "string [18446744073709551615]");

  RosParameterValue list;
  list.type = RosParameterType::kDoubleArray;
  EXPECT_EQ(TextOf(list, TypeOf<double>()).error().message, "a double is no list");
  EXPECT_EQ(TextOf(RosParameterValue(), TypeOf<double>()).error().message, "a parameter cannot be deleted");
}

TEST(RosParameters, HaveNamesWithDots) {
  EXPECT_EQ(RosParameterName("/robot", "/robot/planner/distance"), "planner.distance");
}

TEST(RosParameters, AreDescribed) {
  class Box final : public FrameworkElement {
   public:
    explicit Box(const Placement& placement) : FrameworkElement(placement) {}
  };
  Runtime runtime;
  auto& box = runtime.Create<Box>(runtime.root(), "box");
  const Parameter<double> distance(
      &box, "distance", {.default_value = 0.6, .bounds = {0.2, 3.0}, .unit = "m", .description = "to walls"});
  const auto descriptor = DescribeRosParameter("box.distance", distance);
  EXPECT_EQ(descriptor.type, RosParameterType::kDouble);
  EXPECT_EQ(descriptor.description, "to walls [m]");
  ASSERT_EQ(descriptor.floating_point_range.size(), 1U);
  EXPECT_EQ(descriptor.floating_point_range[0].from_value, 0.2);
  EXPECT_EQ(descriptor.floating_point_range[0].to_value, 3.0);
}

}  // namespace
}  // namespace runnel::test

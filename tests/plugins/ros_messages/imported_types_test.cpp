#include <array>
#include <cstdio>
#include <filesystem>
#include <string>

#include <diagnostic_msgs/diagnostic_array.h>
#include <gmock/gmock.h>
#include <nav_msgs/odometry.h>
#include <rcl_interfaces/log.h>
#include <sensor_msgs/battery_state.h>
#include <sensor_msgs/camera_info.h>
#include <sensor_msgs/imu.h>
#include <sensor_msgs/point_cloud2.h>
#include <sys/wait.h>
#include <visualization_msgs/marker.h>

#include "plugins/cdr_values/cdr_values.h"
#include "plugins/ros_messages/message_codec.h"
#include "plugins/ros_messages/message_library.h"
#include "tests/plugins/cdr_values/random_value.h"
#include "tests/plugins/ros_messages/random_message.h"

namespace runnel::test {
namespace {

using testing::HasSubstr;

// Without any `as`, the type is the message: name, hash and octets.
template <typename T>
void CheckIsMessage(const std::string& name) {
  const MessageLibrary& library = MessageLibrary::Standard();
  const auto made = MessageCodec::Make(TypeOf<T>(), {}, library);
  ASSERT_TRUE(made) << made.error().ToString();
  EXPECT_EQ((*made)->ros_type(), name);
  EXPECT_EQ((*made)->type_hash(), TypeHashOf(**library.Get(name), library));
  EXPECT_THAT((*made)->left_out(), testing::IsEmpty());
  RandomMessage random(21, library);
  for (int i = 0; i < 20; ++i) {
    const auto octets = random.Make(**library.Get(name));
    T value{};
    ASSERT_TRUE((*made)->Decode(octets, &value)) << name;
    std::vector<std::byte> again;
    (*made)->Encode(&value, {}, again);
    ASSERT_TRUE(again == octets) << name;
  }
}

TEST(ImportedTypes, AreTheirMessages) {
  CheckIsMessage<sensor_msgs::Imu>("sensor_msgs/msg/Imu");
  CheckIsMessage<sensor_msgs::BatteryState>("sensor_msgs/msg/BatteryState");
  CheckIsMessage<sensor_msgs::CameraInfo>("sensor_msgs/msg/CameraInfo");
  CheckIsMessage<sensor_msgs::PointCloud2>("sensor_msgs/msg/PointCloud2");
  CheckIsMessage<nav_msgs::Odometry>("nav_msgs/msg/Odometry");
  CheckIsMessage<diagnostic_msgs::DiagnosticArray>("diagnostic_msgs/msg/DiagnosticArray");
  CheckIsMessage<rcl_interfaces::Log>("rcl_interfaces/msg/Log");
  CheckIsMessage<visualization_msgs::Marker>("visualization_msgs/msg/Marker");
  EXPECT_EQ(geometry_msgs::Quaternion{}.w, 1) << "the message's default";
  EXPECT_EQ(sensor_msgs::BatteryState::POWER_SUPPLY_STATUS_FULL, 4);
}

TEST(ImportedTypes, HaveNamesThatCppAllows) {
  MessageLibrary library;
  ASSERT_TRUE(
      library.Add(*ParseMessage("string class \"a'b\"\nbool[] flags\nfloat32[2] pair [1, 2]\nstd_msgs/Empty done\n"
                                "string NAME='x'\nuint64 big 18446744073709551615",
                                "my_msgs/msg/Track", "")));
  const auto files = CppHeadersOf({library.Find("my_msgs/msg/Track")}, library);
  ASSERT_TRUE(files) << files.error().ToString();
  const std::string& text = files->at("my_msgs/track.h");
  EXPECT_THAT(text, HasSubstr("  static constexpr const char* NAME = \"x\";\n"));
  EXPECT_THAT(text, HasSubstr("  std::string class_ = \"a'b\";\n"));
  EXPECT_THAT(text, HasSubstr("  std::vector<std::uint8_t> flags;\n"));
  EXPECT_THAT(text, HasSubstr("  std::array<float, 2> pair = {static_cast<float>(1), static_cast<float>(2)};\n"));
  EXPECT_THAT(text, HasSubstr("  runnel::Signal done;\n"));
  EXPECT_THAT(text, HasSubstr("big = 18446744073709551615U;"));
  EXPECT_THAT(text, HasSubstr(".Field(\"class\", &Track::class_)"));
  EXPECT_EQ(CppHeadersOf({library.Find("std_msgs/msg/Empty")}, library).error().hint, "take runnel::Signal");
}

TEST(ExportedPackage, HasWhatColconWants) {
  MessageLibrary library;
  ASSERT_TRUE(library.Add(*ParseMessage("geometry_msgs/Point at", "my_msgs/msg/Track", "")));
  ASSERT_TRUE(library.Add(*ParseMessage("Track[] tracks", "my_msgs/msg/Tracks", "")));
  const FileTexts files = MessagePackageOf({library.Find("my_msgs/msg/Tracks")}, library);
  EXPECT_EQ(files.at("msg/Track.msg"), "geometry_msgs/Point at\n");
  EXPECT_EQ(files.at("msg/Tracks.msg"), "Track[] tracks\n");
  EXPECT_THAT(files.at("package.xml"), HasSubstr("<depend>geometry_msgs</depend>"));
  EXPECT_THAT(files.at("CMakeLists.txt"),
              HasSubstr("  \"msg/Track.msg\"\n  \"msg/Tracks.msg\"\n  DEPENDENCIES geometry_msgs\n)"));
}

struct Ended {
  int code;
  std::string said;
};
Ended RunRos2(const std::string& arguments) {
  FILE* const pipe = popen((RUNNEL_ROS2_PROGRAM " " + arguments + " 2>&1").c_str(), "r");
  std::string said;
  std::array<char, 4096> buffer;
  for (std::size_t count; (count = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    said.append(buffer.data(), count);
  return {WEXITSTATUS(pclose(pipe)), said};
}

TEST(Ros2Command, ShowsRequestAndResponseOfAService) {
  const Ended ended = RunRos2("show std_srvs/srv/SetBool");
  EXPECT_EQ(ended.code, 0) << ended.said;
  EXPECT_NE(ended.said.find("# std_srvs/srv/SetBool_Request RIHS01_"), std::string::npos) << ended.said;
  EXPECT_NE(ended.said.find("# std_srvs/srv/SetBool_Response RIHS01_"), std::string::npos) << ended.said;
  EXPECT_NE(RunRos2("show std_srvs/srv/SetBoo").code, 0);
}

TEST(Ros2Command, ExportsTheTypesOfPlugins) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "runnel_msgs_of_planning";
  const Ended ended = RunRos2("export planning -o " + folder.string());
  EXPECT_EQ(ended.code, 0) << ended.said;
  MessageLibrary library;
  std::filesystem::create_directories(folder / "runnel_msgs");
  std::filesystem::rename(folder / "msg", folder / "runnel_msgs/msg");
  const auto read = library.Read(folder);
  EXPECT_TRUE(read) << (read ? "" : read.error().ToString());
  EXPECT_TRUE(library.Find("runnel_msgs/msg/PlannerStatus"));
  std::filesystem::remove_all(folder);
}

TEST(Ros2Command, TellsWhatIsWrong) {
  EXPECT_THAT(RunRos2("show sensor_msgs/msg/Imu").said, HasSubstr("sensor_msgs/msg/Imu RIHS01_7d9a00ff"));
  const Ended unknown = RunRos2("import sensor_msgs/msg/Imo");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.said, HasSubstr("did you mean 'sensor_msgs/msg/Imu'?"));
  EXPECT_THAT(RunRos2("export planing").said, HasSubstr("did you mean 'planning'?"));
  EXPECT_EQ(RunRos2("").code, 2);
}

}  // namespace
}  // namespace runnel::test

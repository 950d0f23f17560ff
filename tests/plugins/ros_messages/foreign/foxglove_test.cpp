// Messages read and written by Foxglove's libraries, which are written in TypeScript and know ROS 2's definitions by
// themselves.
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>

#include "modules/types/measurements.h"
#include "plugins/ros_messages/message_codec.h"
#include "plugins/ros_messages/message_library.h"
#include "tests/plugins/ros_messages/random_message.h"

namespace runnel::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class FoxgloveMessages : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(RUNNEL_ROS_MESSAGES_ORACLE "/node_modules/@foxglove/rosmsg2-serialization")) {
      GTEST_SKIP() << "npm could not install Foxglove's libraries when this was built";
    }
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~FoxgloveMessages() override { fs::remove_all(folder_); }

  void Write(const MessageDefinition& definition, const std::string& number,
             const std::vector<std::byte>& octets) const {
    std::string name = definition.name;
    name.replace(name.find("/msg/"), 5, ".");
    std::ofstream(folder_ / (name + "." + number), std::ios::binary)
        .write(reinterpret_cast<const char*>(octets.data()), static_cast<std::streamsize>(octets.size()));
  }

  std::string ReadAndWrite() const {
    const std::string command =
        "cd " RUNNEL_ROS_MESSAGES_ORACLE " && " RUNNEL_NODE " read_and_write.mjs '" + folder_.string() + "' 2>&1";
    FILE* const pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) return "cannot run " + command;
    std::string said;
    std::array<char, 4096> buffer;
    for (std::size_t count; (count = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
      said.append(buffer.data(), count);
    EXPECT_EQ(pclose(pipe), 0) << said;
    return said;
  }

  const fs::path folder_ = fs::path(testing::TempDir()) /
                           (std::string("foxglove_") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(FoxgloveMessages, HaveTheOctetsOfOurDefinitions) {
  const MessageLibrary& library = MessageLibrary::Standard();
  RandomMessage random(3, library);
  std::size_t count = 0;
  for (const MessageDefinition* const each : library.All()) {
    const bool is_known = each->name.find("/msg/") != std::string::npos && !each->name.starts_with("rmw_dds_common/");
    // Foxglove takes what has only constants for no message at all.
    const bool has_only_constants = each->fields.empty() && !each->constants.empty();
    if (!is_known || has_only_constants) continue;
    for (int i = 0; i < 5; ++i, ++count) Write(*each, std::to_string(i), random.Make(*each));
  }
  EXPECT_GT(count, 500U);
  EXPECT_THAT(ReadAndWrite(), HasSubstr(std::to_string(count) + " messages are the same"));
}

TEST_F(FoxgloveMessages, ShowTheValuesOfPorts) {
  const MessageLibrary& library = MessageLibrary::Standard();
  const RangeScan scan{
      .start_angle = -1, .angle_step = 0.5, .range_minimum = 0.125, .range_maximum = 8, .ranges = {1, 2, 3}};
  const auto codec = *MessageCodec::Make(TypeOf<RangeScan>(), {.frame = "laser"}, library);
  std::vector<std::byte> octets;
  codec->Encode(&scan, Time(std::chrono::seconds(7) + Duration(9)), octets);
  Write(**library.Get(codec->ros_type()), "shown", octets);
  EXPECT_THAT(
      ReadAndWrite(),
      HasSubstr(R"(sensor_msgs/LaserScan {"header":{"stamp":{"sec":7,"nanosec":9},"frame_id":"laser"},"angle_min":-1,)"
                R"("angle_max":0,"angle_increment":0.5,"time_increment":0,"scan_time":0,"range_min":0.125,)"
                R"("range_max":8,"ranges":[1,2,3],"intensities":[]})"));
}

}  // namespace
}  // namespace runnel::test

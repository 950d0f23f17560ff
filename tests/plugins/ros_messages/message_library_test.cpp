#include "plugins/ros_messages/message_library.h"

#include <fstream>

#include <gmock/gmock.h>

#include "core/types/type_of.h"
#include "modules/types/drawing.h"
#include "modules/types/planner_status.h"
#include "modules/types/surroundings.h"
#include "tests/plugins/values/example_types.h"

namespace runnel::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

// What `ros2 topic info -v` and others show.
TEST(TypeHash, IsThatOfRos2) {
  const MessageLibrary& library = MessageLibrary::Standard();
  const auto hash = [&](const char* name) { return TypeHashOf(**library.Get(name), library); };
  EXPECT_EQ(hash("std_msgs/msg/String"), "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18");
  EXPECT_THAT(hash("geometry_msgs/msg/Twist"), StartsWith("RIHS01_9c45bf16"));
  EXPECT_THAT(hash("sensor_msgs/msg/LaserScan"), StartsWith("RIHS01_64c19139"));
  EXPECT_THAT(hash("sensor_msgs/msg/Image"), StartsWith("RIHS01_d31d41a9"));
  EXPECT_THAT(hash("sensor_msgs/msg/PointCloud2"), StartsWith("RIHS01_9198cabf"));
  EXPECT_THAT(hash("nav_msgs/msg/Odometry"), StartsWith("RIHS01_3cc97dc7"));
  EXPECT_THAT(hash("tf2_msgs/msg/TFMessage"), StartsWith("RIHS01_e369d0f0"));
  EXPECT_THAT(hash("sensor_msgs/msg/JointState"), StartsWith("RIHS01_a13ee3a3"));
  EXPECT_THAT(hash("sensor_msgs/msg/Imu"), StartsWith("RIHS01_7d9a00ff"));
  EXPECT_THAT(hash("nav_msgs/msg/OccupancyGrid"), StartsWith("RIHS01_8d348150"));
  EXPECT_THAT(hash("rosgraph_msgs/msg/Clock"), StartsWith("RIHS01_692f7a66"));
}

TEST(MessageLibrary, KnowsWhatIsInsideOfItsMessages) {
  const MessageLibrary& library = MessageLibrary::Standard();
  EXPECT_GT(library.All().size(), 150U);
  for (const MessageDefinition* const each : library.All()) {
    for (const MessageField& field : each->fields) {
      const bool is_there = field.type != MessageType::kNested || library.Find(field.nested) != nullptr;
      EXPECT_TRUE(is_there) << each->name << ": " << field.nested;
    }
    const auto again = ParseMessage(TextOf(*each), each->name, "");
    ASSERT_TRUE(again) << each->name << ": " << again.error().ToString();
    EXPECT_EQ(*again, *each);
  }
  EXPECT_EQ(library.Get("sensor_msgs/LaserScam").error().hint, "did you mean 'sensor_msgs/msg/LaserScan'?");
  EXPECT_EQ(library.Get("LaserScan").error().hint, "did you mean 'sensor_msgs/msg/LaserScan'?");
  EXPECT_TRUE(library.Find("sensor_msgs/LaserScan"));
}

TEST(MessageParser, ReadsEverythingThatAMessageCanHave) {
  const auto message = ParseMessage(
      "# a comment\n"
      "uint8 ON=1  # and one behind\n"
      "string GREETING=\"a # b\"\n"
      "\n"
      "char[3] letters\r\n"
      "string<=10[<=5] names [\"a\", \"b\"]\n"
      "Point at\n"
      "geometry_msgs/Pose[] poses\n"
      "builtin_interfaces/msg/Time stamp\n"
      "float64 w 1.0",
      "my_msgs/msg/All", "All.msg");
  ASSERT_TRUE(message) << message.error().ToString();
  EXPECT_EQ(message->constants[1].value, "\"a # b\"");
  EXPECT_EQ(TextOf(*message),
            "uint8 ON=1\nstring GREETING=\"a # b\"\nuint8[3] letters\n"
            "string<=10[<=5] names [\"a\", \"b\"]\nPoint at\ngeometry_msgs/Pose[] poses\n"
            "builtin_interfaces/Time stamp\nfloat64 w 1.0\n");
  EXPECT_EQ(message->fields[2].nested, "my_msgs/msg/Point");
}

TEST(MessageParser, TellsLineAndCure) {
  const auto why_not = [](const char* text) {
    const auto read = ParseMessage(text, "my_msgs/msg/A", "A.msg");
    return read ? "it could be read" : read.error().ToString();
  };
  EXPECT_THAT(why_not("float64 x\nflaot64 y"),
              StartsWith("A.msg:2: there is no type 'flaot64'; did you mean 'float64'?"));
  EXPECT_THAT(why_not("float64"), HasSubstr("'float64' has a type and no name"));
  EXPECT_THAT(why_not("float64 maxSpeed"), HasSubstr("write 'max_speed'"));
  EXPECT_THAT(why_not("float64 x\nfloat64 x"), StartsWith("A.msg:2: there is already a field 'x'"));
  EXPECT_THAT(why_not("float64[0] x"), HasSubstr("'0' is no number of elements"));
  EXPECT_THAT(why_not("float64[<=] x"), HasSubstr("is no number of elements"));
  EXPECT_THAT(why_not("float64] x"), HasSubstr("lacks '['"));
  EXPECT_THAT(why_not("float64<=3 x"), HasSubstr("only strings"));
  EXPECT_THAT(why_not("string<=a x"), HasSubstr("has no length"));
  EXPECT_THAT(why_not("Point X=1"), HasSubstr("a constant is a number"));
  EXPECT_THAT(why_not("uint8 X="), HasSubstr("has no value"));
  EXPECT_THAT(why_not("uint8 x\n---\nuint8 y"), StartsWith("A.msg:2: '---' divides"));
}

class MessageFiles : public testing::Test {
 protected:
  MessageFiles() { fs::create_directories(folder_ / "my_msgs/msg"); }
  ~MessageFiles() override { fs::remove_all(folder_); }

  void Write(const std::string& file, const std::string& text) const {
    fs::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file) << text;
  }
  std::string WhyNot(const std::string& file = "") const {
    MessageLibrary library;
    const std::size_t before = library.All().size();
    const auto read = library.Read(file.empty() ? folder_ : folder_ / file);
    EXPECT_EQ(library.All().size(), before);
    return read ? "it could be read" : read.error().ToString();
  }

  const fs::path folder_ =
      fs::path(testing::TempDir()) /
      ("message_files_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
};

TEST_F(MessageFiles, AreReadByTheirPackages) {
  Write("my_msgs/msg/Tracks.msg", "std_msgs/Header header\nTrack[] tracks\n");
  Write("my_msgs/msg/Track.msg", "uint32 id\ngeometry_msgs/Point at\n");
  MessageLibrary library;
  const auto* const point = library.Find("geometry_msgs/msg/Point");
  const auto read = library.Read(folder_);
  ASSERT_TRUE(read) << read.error().ToString();
  ASSERT_TRUE(library.Find("my_msgs/msg/Tracks"));
  EXPECT_EQ(library.Find("geometry_msgs/msg/Point"), point) << "what was known stays where it is";
  EXPECT_TRUE(library.Read(folder_)) << "again: nothing has changed";
  EXPECT_EQ(library.InsideOf(**library.Get("my_msgs/Tracks")).size(), 4U);
}

TEST_F(MessageFiles, OfServicesAreTwoMessages) {
  Write("my_msgs/msg/Track.msg", "uint32 id\n");
  Write("my_msgs/srv/Follow.srv", "# whom\nTrack track\n---\nbool success\nstring message\n");
  Write("my_msgs/srv/Stop.srv", "---\n");
  MessageLibrary library;
  const auto read = library.Read(folder_);
  ASSERT_TRUE(read) << read.error().ToString();
  const auto* const request = library.Find("my_msgs/srv/Follow_Request");
  ASSERT_TRUE(request);
  EXPECT_EQ(request->fields.front().nested, "my_msgs/msg/Track");
  EXPECT_EQ(library.Find("my_msgs/srv/Follow_Response")->fields.size(), 2U);
  EXPECT_TRUE(library.Find("my_msgs/srv/Stop_Request")->fields.empty());
  EXPECT_TRUE(library.Find("my_msgs/srv/Stop_Response")->fields.empty());
}

TEST_F(MessageFiles, OfServicesThatAreWrongAreToldWithTheirPlace) {
  Write("my_msgs/srv/Follow.srv", "bool a\n---\nfloat x\n");
  EXPECT_THAT(WhyNot("my_msgs/srv"), HasSubstr("Follow.srv:3: there is no type 'float'"));
  Write("my_msgs/srv/Follow.srv", "bool a\n");
  EXPECT_THAT(WhyNot("my_msgs/srv"), HasSubstr("a service has a line '---' between request and response"));
  Write("my_msgs/msg/Follow.srv", "---\n");
  EXPECT_THAT(WhyNot("my_msgs/msg/Follow.srv"), HasSubstr("put it into a folder <package>/srv"));
}

TEST_F(MessageFiles, ThatAreWrongAreToldWithTheirPlace) {
  Write("my_msgs/msg/Track.msg", "geometry_msgs/Pint at\n");
  EXPECT_THAT(WhyNot(), HasSubstr("Track.msg: field 'at': there is no message 'geometry_msgs/msg/Pint'; did you mean "
                                  "'geometry_msgs/msg/Point'?"));
  Write("my_msgs/msg/Track.msg", "Track at\n");
  EXPECT_THAT(WhyNot(), HasSubstr("contains itself"));
  Write("my_msgs/msg/Track.msg", "float x\n");
  EXPECT_THAT(WhyNot(), HasSubstr("Track.msg:1: there is no type 'float'"));
  Write("my_msgs/msg/Track.msg", "");
  Write("loose/A.msg", "");
  EXPECT_THAT(WhyNot("loose/A.msg"), HasSubstr("put it into a folder <package>/msg"));
  Write("my_msgs/msg/a_track.msg", "");
  EXPECT_THAT(WhyNot("my_msgs/msg/a_track.msg"), HasSubstr("call the file ATrack.msg"));
  EXPECT_THAT(WhyNot("my_msgs/msg/None.msg"), HasSubstr("there is no file and no folder"));
  Write("geometry_msgs/msg/Point.msg", "float32 x\n");
  EXPECT_THAT(WhyNot("geometry_msgs"), HasSubstr("there is already another message 'geometry_msgs/msg/Point'"));
}

TEST(DescribedMessage, HasTheFieldsOfTheType) {
  MessageLibrary library;
  const auto status = library.AddDescribed(TypeOf<PlannerStatus>());
  ASSERT_TRUE(status) << status.error().ToString();
  EXPECT_EQ((*status)->name, "runnel_msgs/msg/PlannerStatus");
  EXPECT_THAT(TextOf(**status), HasSubstr("uint8 mode  # 0 motion_to_goal, 1 following_boundary"));
  EXPECT_THAT(TextOf(**status), HasSubstr("float64 distance_to_goal  # [m]\n"));
  EXPECT_THAT(TextOf(**status), HasSubstr("Point2 hit_point\n"));
  const auto map = library.AddDescribed(TypeOf<WorldMap>());
  ASSERT_TRUE(map) << map.error().ToString();
  EXPECT_THAT(TextOf(**map), HasSubstr("MapOutline[] outlines\n"));
  const auto around = library.AddDescribed(TypeOf<Surroundings>());
  EXPECT_THAT(TextOf(**around), HasSubstr("uint16[120] contour"));
  EXPECT_TRUE(library.AddDescribed(TypeOf<PlannerStatus>())) << "the same again";
}

TEST(DescribedMessage, OfListsHasMessagesOfItsOwn) {
  MessageLibrary library;
  using Lists = std::vector<std::vector<double>>;
  const auto lists = library.AddDescribed(TypeOf<Lists>());
  ASSERT_TRUE(lists) << lists.error().ToString();
  EXPECT_EQ((*lists)->name, "runnel_msgs/msg/DoubleListList");
  EXPECT_EQ(TextOf(**lists), "DoubleList[] elements\n");
  const auto matrix = library.AddDescribed(TypeOf<Eigen::MatrixXd>());
  EXPECT_EQ(TextOf(**matrix), "uint32 rows\nuint32 columns\nfloat64[] elements\n");
  EXPECT_EQ(MessageNameOf(TypeOf<double>()), "std_msgs/msg/Float64");
  EXPECT_EQ(MessageNameOf(TypeOf<std::uint8_t>()), "std_msgs/msg/UInt8");
  const auto tree = library.AddDescribed(TypeOf<example::Everything>());
  ASSERT_FALSE(tree);
  EXPECT_THAT(tree.error().message, HasSubstr("a Everything contains itself"));
}

}  // namespace
}  // namespace runnel::test

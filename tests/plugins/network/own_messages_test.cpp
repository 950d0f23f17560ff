// Messages of the user's own .msg files, in application files.
#include <fstream>

#include <gmock/gmock.h>

#include "plugins/application/application_description.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

using testing::HasSubstr;

class OwnMessages : public testing::Test {
 protected:
  OwnMessages() { std::filesystem::create_directories(folder_.path() / "my_msgs/msg"); }

  // What is wrong with an application that offers how fast wheels turn.
  std::string WhyNot(const std::string& messages, const std::string& text,
                     const std::string& take = R"(as="geometry_msgs/msg/Twist")") const {
    std::ofstream(folder_.path() / "my_msgs/msg/Wheels.msg") << text;
    ApplicationOptions options;
    options.plugin_folders = {RUNNEL_TEST_PLUGIN_FOLDER};
    ApplicationDescription description(std::move(options));
    const std::string file = R"(<application name="robot">
  <load plugin="motion"/>
  <thread name="control" period="50ms"/>
  <module name="drive" type="motion/differential_drive"/>
  <network)" + messages + R"(>
    <offer port="drive/wheels" topic="/wheels" as="my_msgs/msg/Wheels"/>
    <take topic="/cmd_vel" to="drive/twist" )" +
                             take + R"(/>
  </network>
</application>)";
    description.ReadText(file, folder_.path(), "robot.xml");
    return description.diagnostics().ToString();
  }

  const TemporaryFolder folder_;
};

TEST_F(OwnMessages, AreReadFromWhereTheFileSays) {
  EXPECT_EQ(WhyNot(R"( messages=".")", "float32 left\nfloat32 right\n"), "");
  EXPECT_EQ(WhyNot(R"( messages="my_msgs/msg/Wheels.msg")", "float32 left\nfloat32 right\n"), "");
  EXPECT_THAT(WhyNot("", "float32 left\n"),
              HasSubstr("robot.xml:6:52: error: /robot: there is no message 'my_msgs/msg/Wheels'"));
}

TEST_F(OwnMessages, ThatDoNotFitAreTold) {
  EXPECT_THAT(
      WhyNot(R"( messages=".")", "flaot32 left\n"),
      HasSubstr("/my_msgs/msg/Wheels.msg:1: error: /robot: there is no type 'flaot32'; did you mean 'float32'?"));
  EXPECT_THAT(WhyNot(R"( messages=".")", "string left\n"), HasSubstr("left: a double is no string"));
  EXPECT_THAT(WhyNot(R"( messages="nowhere")", ""), HasSubstr("nowhere"));
}

TEST_F(OwnMessages, OfThemOneFieldIsTaken) {
  const auto why_not = [&](const std::string& take) {
    return WhyNot(R"( messages=".")",
                  "float32 left\nfloat32 right\ngeometry_msgs/Twist wanted\ngeometry_msgs/Twist[] others", take);
  };
  const std::string mine = R"(as="my_msgs/msg/Wheels" )";
  EXPECT_EQ(why_not(mine + R"(field="wanted")"), "");
  EXPECT_EQ(why_not(mine + R"(field="others[2]")"), "");
  EXPECT_THAT(
      why_not(mine + R"(field="wnated")"),
      HasSubstr("robot.xml:7:76: error: /robot: my_msgs/msg/Wheels has no field 'wnated'; did you mean 'wanted'?"));
  EXPECT_THAT(why_not(mine + R"(field="others")"),
              HasSubstr("robot.xml:7:76: error: /robot: field 'others': a Twist2 is no geometry_msgs/msg/Twist[]; "
                        "of its elements, the first is others[0]"));
  EXPECT_THAT(why_not(R"(field="wanted")"), HasSubstr("robot.xml:7:52: error: /robot: the field 'wanted' is one of a "
                                                      "message, and nobody says of which; say it: as="));
}

}  // namespace
}  // namespace runnel::test

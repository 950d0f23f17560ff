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
  std::string WhyNot(const std::string& messages, const std::string& text) const {
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
    <take topic="/cmd_vel" as="geometry_msgs/msg/Twist" to="drive/twist"/>
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
  EXPECT_THAT(WhyNot("", "float32 left\n"), HasSubstr("robot.xml:6:52: error: /robot: there is no message 'my_msgs/msg/Wheels'"));
}

TEST_F(OwnMessages, ThatDoNotFitAreTold) {
  EXPECT_THAT(WhyNot(R"( messages=".")", "flaot32 left\n"), HasSubstr("/my_msgs/msg/Wheels.msg:1: error: /robot: there is no type 'flaot32'; did you mean 'float32'?"));
  EXPECT_THAT(WhyNot(R"( messages=".")", "string left\n"), HasSubstr("left: a double is no string"));
  EXPECT_THAT(WhyNot(R"( messages="nowhere")", ""), HasSubstr("nowhere"));
}

}  // namespace
}  // namespace runnel::test

// Which ROS 2 the other nodes are of, as application files and the environment say it.
#include <cstdlib>
#include <optional>
#include <string>

#include <gmock/gmock.h>

#include "plugins/application/application_description.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class RosDistribution : public testing::Test {
 protected:
  ~RosDistribution() override { before_ ? setenv(kName, before_->c_str(), 1) : unsetenv(kName); }
  // What is said of an application that is a node, where ROS_DISTRO has that value.
  static std::string Said(const char* environment, const std::string& distribution = "") {
    environment != nullptr ? setenv(kName, environment, 1) : unsetenv(kName);
    ApplicationOptions options;
    options.plugin_folders = {RUNNEL_TEST_PLUGIN_FOLDER};
    ApplicationDescription description(std::move(options));
    description.ReadText(R"(<application name="robot">
  <network reach="network">
    <ros )" + distribution + R"(/>
  </network>
</application>)",
                         ".", "robot.xml");
    return description.diagnostics().ToString();
  }

 private:
  static constexpr const char* kName = "ROS_DISTRO";
  static std::optional<std::string> Now() {
    const char* const value = std::getenv(kName);
    return value != nullptr ? std::optional<std::string>(value) : std::nullopt;
  }
  const std::optional<std::string> before_ = Now();
};

constexpr const char* kInNoList = "the application is in no list of nodes";

TEST_F(RosDistribution, IsWhatTheEnvironmentSaysIfTheFileSaysNone) {
  for (const char* const each : {"foxy", "galactic", "humble", "iron", "jazzy", "kilted", "rolling"}) {
    EXPECT_EQ(Said(each), "");
    EXPECT_EQ(Said(nullptr, "distribution=\"" + std::string(each) + "\""), "");
  }
  EXPECT_EQ(Said("galctic", R"(distribution="jazzy")"), "") << "the file counts more";
}

TEST_F(RosDistribution, ThatNobodySaysIsWarnedOf) {
  for (const char* const each : {static_cast<const char*>(nullptr), ""}) {
    EXPECT_THAT(Said(each), AllOf(HasSubstr("robot.xml:3:5: warning: /robot"), HasSubstr(kInNoList)));
    EXPECT_THAT(Said(each), Not(HasSubstr("names no distribution")));
  }
}

TEST_F(RosDistribution, ThatThereIsNotIsWarnedOfWithTheNearest) {
  EXPECT_THAT(Said("galctic"), AllOf(HasSubstr("ROS_DISTRO names no distribution of ROS 2: 'galctic'"),
                                     HasSubstr("did you mean 'galactic'?"), HasSubstr(kInNoList)));
  EXPECT_THAT(Said(nullptr, R"(distribution="galctic")"),
              AllOf(HasSubstr("error"), HasSubstr("did you mean 'galactic'?")));
}

}  // namespace
}  // namespace runnel::test

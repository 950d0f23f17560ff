// The program as its user meets it: what it prints, how it ends.

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "tests/integration/program.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;

/// An application file of the test's own.
class CommandLine : public testing::Test {
 protected:
  std::string Write(const std::string& text) {
    std::ofstream(file_) << text;
    return file_.string() + " ";
  }

  const TemporaryFolder folder_;  // a world is looked for beside the file, too
  const std::filesystem::path file_ = folder_ / "application.xml";
};

TEST_F(CommandLine, RunEndsWithVerdictPathAndTime) {
  const std::string picture = testing::TempDir() + "command_line_test_" + std::to_string(getpid()) + ".svg";
  std::filesystem::remove(picture);
  const Ended ended = Runnel("run --fast " + kDemo + "world=" RUNNEL_XML "/worlds/open.xml picture=" + picture);
  EXPECT_EQ(ended.code, kDone) << ended.text;
  EXPECT_THAT(ended.text, HasSubstr("reached: path "));
  EXPECT_THAT(ended.text, HasSubstr("times real time"));
  EXPECT_GT(std::filesystem::file_size(picture), 1000u);
  std::filesystem::remove(picture);
}

TEST_F(CommandLine, WhatComesWithRunnelIsKnownByItsName) {
  EXPECT_EQ(Runnel("check bug_demo world=maze").code, kDone);
  const Ended ended = Runnel("check bug_demos");
  EXPECT_EQ(ended.code, kBadInput);
  EXPECT_THAT(ended.text, HasSubstr("bug_demos"));
}

TEST_F(CommandLine, CheckKnowsConversionsAndNamesWhatWouldFit) {
  const char* const head = R"(<application name="app">
  <load plugin="simulation"/> <load plugin="motion"/>
  <thread name="main" period="10ms"/>
  <module name="world" type="simulation/world"> <parameter name="world" value="rooms"/> </module>
  <module name="laser" type="simulation/laser"/>
  <module name="drive" type="motion/differential_drive"/>
  <connect from="world/scene" to="laser/scene"/>
  <connect from="world/pose" to="laser/pose"/>
  <connect from="drive/wheels" to="world/wheels" late="true"/>
)";
  const Ended good = Runnel("check " + Write(std::string(head) + R"(
  <module name="bumper" type="simulation/bumper" tags="safety"/>
  <connect from="world/contact" to="bumper/truth"/>
  <connect from="driver/twist" to="drive/twist" when="present"/>
</application>)"));
  EXPECT_EQ(good.code, kDone) << good.text;
  const Ended wrong = Runnel("check " + Write(std::string(head) + R"(
  <connect from="world/pose" to="drive/twist"/>
</application>)"));
  EXPECT_EQ(wrong.code, kBadInput);
  EXPECT_THAT(wrong.text, HasSubstr("carries Pose2, but /app/drive/input/twist takes Twist2"));
}

// All that a run would refuse when its modules are made ready, at once, and with the same words.
TEST_F(CommandLine, CheckTellsOfFilesThatAreNotThereAndOfSettingsThatCannotBeUsed) {
  const Ended ended = Runnel("check " + Write(R"(<application name="app" thread="main">
  <load plugin="simulation"/> <load plugin="adaptors"/> <load plugin="motion"/>
  <thread name="main" period="10ms"/> <clock type="simulated"/>
  <module name="world" type="simulation/world"> <parameter name="world" value="romms"/> </module>
  <module name="laser" type="simulation/laser"> <parameter name="range_minimum" value="9"/> </module>
  <module name="bumper" type="simulation/bumper"/>
  <module name="touch" type="adaptors/bumper"> <parameter name="body_radius" value="1"/> </module>
  <module name="drive" type="motion/differential_drive"/>
  <connect from="world/scene" to="laser/scene"/> <connect from="world/pose" to="laser/pose touch/pose"/>
  <connect from="world/contact" to="bumper/truth"/> <connect from="bumper/contact" to="touch/contact"/>
  <connect from="drive/wheels" to="world/wheels" late="true"/> <connect from="driver/twist" to="drive/twist" when="present"/>
</application>)"));
  EXPECT_EQ(ended.code, kBadInput);
  EXPECT_THAT(ended.text, AllOf(HasSubstr("/app/world: "), HasSubstr("there is no world")));
  EXPECT_THAT(ended.text, HasSubstr(file_.string() + ":4:3"));
  EXPECT_THAT(ended.text, HasSubstr("the laser sees nothing"));
  EXPECT_THAT(ended.text, HasSubstr("is not above the body's radius"));
  EXPECT_THAT(ended.text, Not(HasSubstr("no errors")));
}

TEST_F(CommandLine, RunThatFailsEndsWithOne) {
  const Ended ended =
      Runnel("run --fast " + kDemo + "world=" RUNNEL_XML "/worlds/unreachable.xml expected=reached picture=");
  EXPECT_EQ(ended.code, kRunFailed) << ended.text;
  EXPECT_THAT(ended.text, HasSubstr("unreachable: path "));
}

TEST_F(CommandLine, BadInputEndsWithTwoAndTellsAllAtOnce) {
  const std::string file = Write(R"(<application name="wrong">
  <load plugin="motion"/>
  <thread name="main" period="50ms"/>
  <module name="gate" type="motion/comand_gate"/>
  <module name="drive" type="motion/differential_drive">
    <parameter name="trak" value="1"/>
    <parameter name="maximum_speed" value="-1"/>
  </module>
  <connect from="drive/wheels" to="drive/twist"/>
</application>
)");
  for (const char* command : {"check ", "run --fast "}) {
    const Ended ended = Runnel(command + file);
    EXPECT_EQ(ended.code, kBadInput) << ended.text;
    EXPECT_THAT(ended.text, HasSubstr(file_.string() + ":4:"));
    EXPECT_THAT(ended.text, HasSubstr("did you mean 'motion/command_gate'?"));
    EXPECT_THAT(ended.text, HasSubstr(file_.string() + ":6:"));
    EXPECT_THAT(ended.text, HasSubstr("did you mean 'track'?"));
    EXPECT_THAT(ended.text, HasSubstr(file_.string() + ":7:"));
    EXPECT_THAT(ended.text, HasSubstr("allowed is 0 .. 20 m/s"));
    EXPECT_THAT(ended.text, HasSubstr(file_.string() + ":9:"));
    EXPECT_THAT(ended.text, HasSubstr("WheelSpeeds"));
  }
}

TEST_F(CommandLine, UnconnectedRequiredInputsAreErrors) {
  const Ended ended = Runnel("check " + Write(R"(<application name="loose">
  <load plugin="motion"/>
  <module name="drive" type="motion/differential_drive"/>
</application>
)"));
  EXPECT_EQ(ended.code, kBadInput);
  EXPECT_THAT(ended.text, AllOf(HasSubstr(":3:"), HasSubstr("drive/input/twist")));
}

TEST_F(CommandLine, AWrongWorldFileIsToldWithItsLine) {
  const std::string world = Write("<world name=\"w\">\n<start x=\"0\" y=\"zero\"/>\n</world>\n");
  const Ended ended = Runnel("run --fast " + kDemo + "picture= world=" + world);
  EXPECT_EQ(ended.code, kBadInput);
  EXPECT_THAT(ended.text, AllOf(HasSubstr(file_.string() + ":2:"), HasSubstr("goal")));
}

TEST_F(CommandLine, MisspeltSettingsAreErrors) {
  const Ended ended = Runnel("check " + kDemo + "goal_z=4");
  EXPECT_EQ(ended.code, kBadInput);
  EXPECT_THAT(ended.text, HasSubstr("did you mean 'goal_x'?"));
}

TEST_F(CommandLine, AFileThatIsNotThereIsBadInput) {
  EXPECT_EQ(Runnel("run /nowhere/app.xml").code, kBadInput);
  EXPECT_EQ(Runnel("run").code, kBadInput);
  EXPECT_EQ(Runnel("--no-such-option").code, kBadInput);
  EXPECT_EQ(Runnel("nonsense").code, kBadInput);
}

TEST_F(CommandLine, CheckOfGoodFilesIsDone) {
  for (const auto& entry : std::filesystem::directory_iterator(RUNNEL_XML "/apps")) {
    if (entry.path().extension() != ".xml") continue;
    // Those that need a network are no good where it has no engine.
    if (!RUNNEL_HAS_NETWORK && entry.path().stem().string().starts_with("two_robots")) continue;
    const Ended ended = Runnel("check " + entry.path().string());
    EXPECT_EQ(ended.code, kDone) << ended.text;
  }
}

TEST_F(CommandLine, ModulesListsTypesWithPortsAndParameters) {
  const Ended ended = Runnel("modules motion");
  EXPECT_EQ(ended.code, kDone);
  EXPECT_THAT(ended.text, AllOf(HasSubstr("motion/command_gate"), HasSubstr("wanted"), HasSubstr("Twist2"),
                                HasSubstr("wanted_timeout"), HasSubstr("0 .. 3600"), Not(HasSubstr("planning/"))));
}

TEST_F(CommandLine, ModulesAreToldToProgramsAsJson) {
  const Ended ended = Runnel("modules motion --json");
  EXPECT_EQ(ended.code, kDone);
  const auto json = nlohmann::json::parse(ended.text);
  ASSERT_EQ(json.size(), 2u);
  EXPECT_EQ(json[0]["type"], "motion/command_gate");
  EXPECT_EQ(json[0]["plugin"], "motion");
  EXPECT_FALSE(json[0]["ports"].empty());
  EXPECT_EQ(Runnel("modules motion --json --names").code, kBadInput);
}

TEST_F(CommandLine, HelpAndVersionAreDone) {
  EXPECT_EQ(Runnel("--help").code, kDone);
  for (const char* words : {"version", "--version"}) {
    const Ended ended = Runnel(words);
    EXPECT_EQ(ended.code, kDone);
    EXPECT_EQ(ended.text, "runnel " RUNNEL_VERSION "\n");
  }
}

TEST_F(CommandLine, NumbersThatNoClockCouldHoldAreRefused) {
  for (const char* option : {"--duration 1e10", "--duration 0", "--duration -1", "--duration nan", "--speed 1e-300",
                             "--speed 1e7", "--speed -1"}) {
    const Ended ended = Runnel(std::string("run ") + option + " " + kDemo);
    EXPECT_EQ(ended.code, kBadInput) << option;
    const std::string number = std::string(option).substr(std::string(option).find(' ') + 1);
    EXPECT_THAT(ended.text, HasSubstr("'" + number + "' is n"));
  }
}

TEST_F(CommandLine, AnEmptyFileNameIsRefusedAsSuch) {
  const Ended ended = Runnel("check ''");
  EXPECT_EQ(ended.code, kBadInput);
  EXPECT_THAT(ended.text, HasSubstr("'' is not the name of a file"));
}

TEST_F(CommandLine, TimeThatIsUpIsNoFailure) {
  const Ended ended = Runnel("run --fast --duration 1.23 " + kDemo + "picture=");
  EXPECT_EQ(ended.code, kDone);
  EXPECT_THAT(ended.text, AllOf(HasSubstr("the time is up"), HasSubstr("simulated 1.23 s")));
}

TEST_F(CommandLine, ProgressIsToldOnceASecond) {
  const Ended ended = Runnel("run --speed 1 --duration 1.5 " + kDemo + "picture=");
  EXPECT_EQ(ended.code, kDone);
  EXPECT_THAT(ended.text, ContainsRegex(" s  x[0-9.]+ +[0-9.]+ m to the goal, [a-z ]+\n"));
  EXPECT_THAT(ended.text, Not(HasSubstr("\r")));
}

TEST_F(CommandLine, QuietRunsTellOnlyHowTheyEnded) {
  const Ended ended = Runnel("run --quiet --speed 200 " + kDemo + "picture=");
  EXPECT_THAT(ended.text, MatchesRegex("reached: path [0-9.]+ m, time [0-9.]+ s\n"));
  EXPECT_EQ(Runnel("run --quiet --fast --duration 1 " + kDemo + "picture=").text, "the time is up\n");
}

TEST_F(CommandLine, StatisticsTellOfEachThread) {
  const Ended ended = Runnel("run --fast --duration 1 --statistics " + kDemo + "picture=");
  EXPECT_THAT(ended.text, HasSubstr("jitter / ms"));
  EXPECT_THAT(ended.text, ContainsRegex("/bug_demo/threads/control +20 +0 +50\\.000 +50\\.000"));
}

TEST_F(CommandLine, ConfigurationFilesGiveValuesToParameters) {
  const std::string configuration = Write(R"(<configuration>
  <section name="limits"><value name="time">0.5</value></section>
</configuration>
)");
  const std::filesystem::path application = file_.string() + ".app.xml";
  std::ifstream demo(RUNNEL_XML "/apps/bug_demo.xml");
  std::string text{std::istreambuf_iterator<char>(demo), {}};
  const std::string referee = "<module name=\"referee\" type=\"simulation/referee\">";
  text.insert(text.find(referee) + referee.size(), "<parameter name=\"time_limit\" config=\"/limits/time\"/>");
  std::ofstream(application) << text;
  const Ended ended = Runnel("run --fast --config " + configuration + application.string() +
                             " picture= world=" RUNNEL_XML "/worlds/open.xml");
  std::filesystem::remove(application);
  EXPECT_EQ(ended.code, kRunFailed) << ended.text;
  EXPECT_THAT(ended.text, HasSubstr("timeout: "));
}

std::string ContentOf(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Two processes have their memory in different places; nothing of that may show.
TEST_F(CommandLine, TheSameRunInAnotherProcessIsTheSameBitForBit) {
  const std::filesystem::path bug1 = file_.string() + ".bug1.xml";
  std::string text = ContentOf(RUNNEL_XML "/apps/bug_demo.xml");
  text.replace(text.find("planning/bug2\""), 14, "planning/bug1\"");
  std::ofstream(bug1) << text;
  for (const std::string& application :
       {kDemo, bug1.string() + " ", std::string(RUNNEL_XML "/apps/bug_infrared.xml ")}) {
    std::vector<std::string> pictures;
    for (const char* name : {"first.svg", "second.svg"}) {
      const std::filesystem::path picture = file_.string() + name;
      const Ended ended = Runnel("run --fast --quiet " + application + "world=" RUNNEL_XML "/worlds/one_obstacle.xml " +
                                 "noise=0.01 picture=" + picture.string());
      EXPECT_THAT(ended.text, HasSubstr(": path ")) << ended.text;
      pictures.push_back(ContentOf(picture));
      std::filesystem::remove(picture);
    }
    EXPECT_GT(pictures[0].size(), 1000u);
    EXPECT_TRUE(pictures[0] == pictures[1]) << application;
  }
  std::filesystem::remove(bug1);
}

}  // namespace
}  // namespace runnel::test

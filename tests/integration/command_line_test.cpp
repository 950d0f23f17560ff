// The program as its user meets it: what it prints, how it ends.

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <sys/wait.h>

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;

constexpr int kDone = 0, kRunFailed = 1, kBadInput = 2;

struct Ended {
  int code = -1;
  std::string text;  ///< standard output and errors
};

Ended Runnel(const std::string& arguments) {
  const std::string command = std::string(RUNNEL_PROGRAM) + " " + arguments + " 2>&1";
  Ended ended;
  std::FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return ended;
  std::array<char, 4096> part{};
  while (const std::size_t size = std::fread(part.data(), 1, part.size(), pipe)) {
    ended.text.append(part.data(), size);
  }
  const int status = pclose(pipe);
  if (WIFEXITED(status)) ended.code = WEXITSTATUS(status);
  return ended;
}

const std::string kDemo = std::string(RUNNEL_XML) + "/apps/bug_demo.xml ";

/// An application file of the test's own.
class CommandLine : public testing::Test {
 protected:
  std::string Write(const std::string& text) {
    std::ofstream(file_) << text;
    return file_.string() + " ";
  }
  void TearDown() override { std::filesystem::remove(file_); }

  std::filesystem::path file_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".xml");
};

TEST_F(CommandLine, RunEndsWithVerdictPathAndTime) {
  const std::string picture = testing::TempDir() + "command_line_test.svg";
  std::filesystem::remove(picture);
  const Ended ended =
      Runnel("run --fast " + kDemo + "world=" RUNNEL_XML "/worlds/open.xml picture=" + picture);
  EXPECT_EQ(ended.code, kDone) << ended.text;
  EXPECT_THAT(ended.text, HasSubstr("reached: path "));
  EXPECT_THAT(ended.text, HasSubstr("times real time"));
  EXPECT_GT(std::filesystem::file_size(picture), 1000u);
}

TEST_F(CommandLine, RunThatFailsEndsWithOne) {
  const Ended ended =
      Runnel("run --fast " + kDemo +
             "world=" RUNNEL_XML "/worlds/unreachable.xml expected=reached picture=");
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
    const Ended ended = Runnel("check " + entry.path().string());
    EXPECT_EQ(ended.code, kDone) << ended.text;
  }
}

TEST_F(CommandLine, ModulesListsTypesWithPortsAndParameters) {
  const Ended ended = Runnel("modules motion");
  EXPECT_EQ(ended.code, kDone);
  EXPECT_THAT(ended.text,
              AllOf(HasSubstr("motion/command_gate"), HasSubstr("wanted"), HasSubstr("Twist2"),
                    HasSubstr("timeout"), HasSubstr("0.01 .. 60"), Not(HasSubstr("planning/"))));
}

TEST_F(CommandLine, HelpAndVersionAreDone) {
  EXPECT_EQ(Runnel("--help").code, kDone);
  const Ended ended = Runnel("version");
  EXPECT_EQ(ended.code, kDone);
  EXPECT_THAT(ended.text, HasSubstr(RUNNEL_VERSION));
}

}  // namespace
}  // namespace runnel::test

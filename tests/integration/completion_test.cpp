// What bash completes on the command line of the program.

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <unistd.h>

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::Not;

// What is offered for the last of `words`.
std::vector<std::string> Completed(const std::string& words) {
  const std::string program = RUNNEL_PROGRAM;
  const std::string script = "export PATH=\"" + program.substr(0, program.rfind('/')) +
                             ":$PATH\"; cd " RUNNEL_XML "; source " RUNNEL_COMPLETION "; COMP_WORDS=(runnel " + words +
                             "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _runnel; printf \"%s\\n\" \"${COMPREPLY[@]}\"";
  FILE* const pipe = popen(("bash -c '" + script + "' 2>&1").c_str(), "r");
  std::string text;
  std::array<char, 4096> block{};
  while (const std::size_t count = fread(block.data(), 1, block.size(), pipe)) {
    text.append(block.data(), count);
  }
  pclose(pipe);
  std::istringstream lines(text);
  std::vector<std::string> offered;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty()) offered.push_back(line);
  }
  std::ranges::sort(offered);
  return offered;
}

TEST(Completion, KnowsTheCommands) {
  EXPECT_THAT(Completed("gr"), ElementsAre("graph"));
  EXPECT_THAT(Completed("\"\""), AllOf(Contains("run"), Contains("schema"), Contains("version")));
}

TEST(Completion, OfAReplayFirstTheRecordingAndThenTheApplication) {
  EXPECT_THAT(Completed("replay apps/bug_d"), testing::IsEmpty());
  EXPECT_THAT(Completed("replay run.mcap apps/bug_d"), ElementsAre("apps/bug_demo.xml"));
  EXPECT_THAT(Completed("replay run.mcap apps/bug_demo.xml go"), ElementsAre("goal_x=", "goal_y="));
}

// An application file from somebody else, and the key Tab.
TEST(Completion, CarriesOutNothingThatStandsInAFile) {
  const auto folder = std::filesystem::path(testing::TempDir()) / ("completion_test_" + std::to_string(getpid()));
  std::filesystem::create_directory(folder);
  const std::string file = folder / "app.xml", made = folder / "made";
  std::ofstream(file) << "<parameter command_line=\"$(touch${IFS}" << made
                      << ")\"/>\n<parameter command_line=\"speed\"/>\n";
  EXPECT_THAT(Completed("run " + file + " s"), ElementsAre("speed="));
  EXPECT_FALSE(std::filesystem::exists(made));
  std::filesystem::remove_all(folder);
}

// An extension from somebody else.
TEST(Completion, CarriesOutNothingThatIsTheNameOfAnOption) {
  const auto folder = std::filesystem::path(testing::TempDir()) / ("completion_test_" + std::to_string(getpid()));
  std::filesystem::create_directory(folder);
  const std::string name = "$(touch$IFS" + (folder / "made").string() + ")";
  std::ofstream(folder / "evil.extension.xml") << "<extension summary=\"is evil\">\n<option name=\"" << name
                                               << "\" command=\"run\" kind=\"flag\" summary=\"none\"/>\n</extension>\n";
  setenv("RUNNEL_PLUGIN_PATH", folder.c_str(), 1);
  EXPECT_THAT(Completed("run --"), Contains("--" + name));
  unsetenv("RUNNEL_PLUGIN_PATH");
  EXPECT_FALSE(std::filesystem::exists(folder / "made"));
  std::filesystem::remove_all(folder);
}

TEST(Completion, KnowsTheOptionsOfEachCommand) {
  EXPECT_THAT(Completed("run --st"), ElementsAre("--statistics"));
  EXPECT_THAT(Completed("check --"), Not(Contains("--statistics")));
}

TEST(Completion, KnowsFilesAndFolders) {
  EXPECT_THAT(Completed("run apps/bug_d"), ElementsAre("apps/bug_demo.xml"));
  EXPECT_THAT(Completed("run ap"), ElementsAre("apps"));
  EXPECT_THAT(Completed("run README"), testing::IsEmpty());
}

TEST(Completion, KnowsTheSettingsOfTheApplication) {
  EXPECT_THAT(Completed("run apps/bug_demo.xml go"), ElementsAre("goal_x=", "goal_y="));
  EXPECT_THAT(Completed("run --speed 2 apps/bug_demo.xml wor"), ElementsAre("world="));
}

// Bash takes the '=' for a word of its own.
TEST(Completion, KnowsFilesAsValuesOfSettings) {
  EXPECT_THAT(Completed("run apps/bug_demo.xml world = worlds/op"), ElementsAre("worlds/open.xml"));
  EXPECT_THAT(Completed("run apps/bug_demo.xml world ="), Contains("worlds"));
}

TEST(Completion, KnowsPlugins) {
  EXPECT_THAT(Completed("modules plan"), ElementsAre("planning"));
  EXPECT_THAT(Completed("schema mo"), ElementsAre("motion"));
}

// Else somebody has added a command and forgotten this.
TEST(Completion, KnowsAllThatTheHelpNames) {
  const std::string command = std::string(RUNNEL_PROGRAM) + " --help";
  FILE* const pipe = popen(command.c_str(), "r");
  std::array<char, 4096> line{};
  bool is_command = false;
  const std::vector<std::string> known = Completed("\"\"");
  while (fgets(line.data(), static_cast<int>(line.size()), pipe) != nullptr) {
    const std::string text(line.data());
    if (text.starts_with("Subcommands:")) {
      is_command = true;
    } else if (is_command && text.starts_with("  ") && text[2] != ' ') {
      const std::string name = text.substr(2, text.find(' ', 2) - 2);
      EXPECT_THAT(known, Contains(name));
    }
  }
  pclose(pipe);
  EXPECT_TRUE(is_command);
}

}  // namespace
}  // namespace runnel::test

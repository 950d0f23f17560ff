// What an application can do without is in its process only if somebody asks for it.

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>

#include "tests/integration/program.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string kPausedDemo = "run --paused " + kDemo + "picture= ";

class ExtensionsOfARun : public testing::Test {
 protected:
  ExtensionsOfARun() { setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1); }

  TemporaryFolder folder_;
};

TEST_F(ExtensionsOfARun, AreNotInAProcessThatNeedsNone) {
  Program program(kPausedDemo);
  ASSERT_TRUE(program.WaitFor("paused"));
  const std::string maps = program.Maps();
  EXPECT_THAT(maps, HasSubstr("/librunnel_application.so"));
  for (const char* file :
       {"inspector", "web_server", "foxglove", "mcap", "recording", "tracing", "finroc", "viewers"}) {
    EXPECT_THAT(maps, Not(HasSubstr(file)));
  }
}

TEST_F(ExtensionsOfARun, AreLoadedByTheirOptions) {
  Program program(kPausedDemo + "--inspect=0");
  ASSERT_TRUE(program.WaitFor("paused"));
  EXPECT_THAT(program.Maps(),
              AllOf(HasSubstr("/viewers.so"), HasSubstr("/librunnel_inspector.so"), Not(HasSubstr("mcap"))));
}

TEST_F(ExtensionsOfARun, AreLoadedWhenATerminalWantsARecording) {
  Program program(kPausedDemo);
  ASSERT_TRUE(program.WaitFor("paused"));
  ASSERT_THAT(program.Maps(), Not(HasSubstr("mcap")));
  Program recording("record -o " + (folder_ / "run.mcap").string());
  WaitUntil("the recording has begun", [&] { return std::filesystem::exists(folder_ / "run.mcap"); });
  EXPECT_THAT(program.Maps(), HasSubstr("/librunnel_mcap.so"));
  recording.WaitUntilHandles(SIGINT, true);
  recording.Send(SIGINT);
  const Ended ended = recording.Wait();
  EXPECT_EQ(ended.code, kDone) << ended.text;
  EXPECT_THAT(ended.text, HasSubstr("recorded "));
}

TEST_F(ExtensionsOfARun, ThatAreNotInstalledAreToldByName) {
  std::ofstream(folder_ / "radar.extension.xml")
      << "<extension summary=\"looks far\"><tag name=\"radar\"/><command name=\"sweep\"/>"
         "<option name=\"radar\"/></extension>";
  std::ofstream(folder_ / "app.xml") << "<application name=\"a\"><radar/></application>";
  const auto run = [&](const std::string& arguments) {
    const std::string said = folder_ / "said";
    const std::string command =
        "RUNNEL_PLUGIN_PATH=" + folder_.path().string() + " " RUNNEL_PROGRAM " " + arguments + " >" + said + " 2>&1";
    EXPECT_NE(std::system(command.c_str()), 0);
    std::ifstream stream(said);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  const std::string missing = " the extension 'radar', which is not installed; it looks far";
  EXPECT_THAT(run("check " + (folder_ / "app.xml").string()), HasSubstr("app.xml:1:23: error: "));
  EXPECT_THAT(run("check " + (folder_ / "app.xml").string()), HasSubstr("<radar> needs" + missing));
  EXPECT_THAT(run("run --radar " + kDemo), HasSubstr("--radar needs" + missing));
  EXPECT_THAT(run("sweep"), HasSubstr("'sweep' is of" + missing));
}

}  // namespace
}  // namespace runnel::test

// Memory is short again and again, in all threads of a robot with network, page and rules: it goes on, and a STOP holds.

#include <csignal>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>

#include "tests/integration/two_robots.h"

namespace runnel::test {
namespace {

class ShortMemory : public TwoRobots {
 protected:
  /// Who finds the line closed asks again; it may have been done, and only the answer be lost.
  static void Stop() {
    WaitUntil("it is stopped", [] { return Runnel("stop --app robot").code == kDone; });
    WaitForText("ps", "STOP in force");
  }
  static void Release() {
    WaitUntil("it is released", [] {
      const Ended ended = Runnel("release --app robot");
      return ended.code == kDone || ended.text.find("STOP is not in force") != std::string::npos;
    });
  }
};

TEST_F(ShortMemory, ARobotGoesOnAndIsStopped) {
  const std::string file = folder_ / "short";
  const auto planner = Start("two_robots_planner.xml");
  Program robot("run " + kApps + "two_robots.xml --quiet --inspect=0",
                "env LD_PRELOAD=" RUNNEL_SHORT_MEMORY_LIBRARY " RUNNEL_SHORT_MEMORY=" + file + " " RUNNEL_PROGRAM);
  WaitUntilItDrives();
  std::ofstream(file) << "now\n";
  for (int i = 0; i < 8; ++i) {
    Stop();
    for (const char* const command :
         {"get --app robot /gate/wanted", "publish --app robot /gate/wanted '{forward: 0.1}'",
          "release --app robot /gate/wanted", "pause --app robot /laser", "resume --app robot /laser",
          "undo --app robot", "log --app robot", "ls --app robot"}) {
      (void)Runnel(command);
    }
    Release();
  }
  std::filesystem::remove(file);
  Stop();
  EXPECT_THAT(Runnel("get --app robot /gate/wanted").text, testing::HasSubstr("forward"));
  robot.Send(SIGINT);
  const Ended ended = robot.Wait();
  EXPECT_EQ(ended.signal, 0) << ended.text;
  EXPECT_EQ(ended.code, kDone) << ended.text;
}

}  // namespace
}  // namespace runnel::test

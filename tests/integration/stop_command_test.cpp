// The STOP of the robot from a terminal: at once, whatever goes on, in all applications, and no one drives on by himself.

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "tests/integration/program.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Two motors: one is commanded in every cycle, the other by hand.
class StopCommand : public testing::Test {
 protected:
  StopCommand() { setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1); }
  ~StopCommand() override { unsetenv("XDG_RUNTIME_DIR"); }

  [[nodiscard]] std::string Write(const std::string& name) const {
    const std::string file = folder_ / (name + ".xml");
    std::ofstream(file) << "<application name=\"" << name << R"("> <load plugin="faulty"/>
  <clock type="real"/> <thread name="main" period="5ms"/>
  <module name="commander" type="faulty/counter"> <parameter name="first" value="1"/> </module>
  <module name="motor" type="faulty/motor"/> <module name="other" type="faulty/motor"/>
  <connect from="commander/count" to="motor/speed"/>
</application>)";
    return "run --quiet " + file;
  }

  TemporaryFolder folder_;
};

TEST_F(StopCommand, TakesEffectWhileAModuleIsBeingMadeAndEndsWithNewCommandsOnly) {
  Program program(Write("robot"));
  ASSERT_TRUE(program.WaitFor("/robot/motor: moves"));
  ASSERT_EQ(Runnel("publish /other/speed 2").code, kDone);
  ASSERT_TRUE(program.WaitFor("/robot/other: moves"));
  const std::string made_after = folder_ / "made";
  Program create("create /slow faulty/slow_to_make made_after=" + made_after);
  WaitUntil("the module is being made", [&] { return std::filesystem::exists(made_after + ".begun"); });

  const Ended stopped = Runnel("stop");
  EXPECT_EQ(stopped.code, kDone);
  EXPECT_THAT(stopped.text, AllOf(HasSubstr("robot ("), HasSubstr("): STOP is in force; 'runnel release' ends it")));
  EXPECT_TRUE(program.WaitFor("/robot/motor: stands"));
  EXPECT_TRUE(program.WaitFor("/robot/other: stands"));
  EXPECT_THAT(Runnel("ps").text, HasSubstr("running, STOP in force for"));
  std::ofstream(made_after) << "\n";
  const Ended created = create.Wait();
  EXPECT_EQ(created.code, kBadInput);
  EXPECT_THAT(created.text, HasSubstr("STOP was pressed or released after this was asked for"));

  const Ended released = Runnel("release");
  EXPECT_EQ(released.code, kDone);
  EXPECT_THAT(released.text, HasSubstr("released the STOP that a terminal had pressed; what drives: "
                                       "/robot/motor/input/speed, /robot/other/input/speed"));
  WaitUntil("the motor that is commanded again moves again", [&] {
    const std::string log = Runnel("log").text;
    return log.rfind("/robot/motor: moves") > log.rfind("/robot/motor: stands");
  });
  EXPECT_THAT(Runnel("get /other/speed").text, HasSubstr("0")) << "its command is from before";
  EXPECT_EQ(Runnel("publish /other/speed 3").code, kDone);
  WaitUntil("by a new command the other one moves, too", [&] {
    const std::string log = Runnel("log").text;
    return log.rfind("/robot/other: moves") > log.rfind("/robot/other: stands");
  });
  EXPECT_EQ(Runnel("quit").code, kDone);
  EXPECT_EQ(program.Wait().code, kDone);
}

TEST_F(StopCommand, StopsAllApplicationsAndSaysOfEachWhetherItHas) {
  Program first(Write("first"));
  Program second(Write("second"));
  Program third(Write("third"));
  for (Program* each : {&first, &second, &third}) ASSERT_TRUE(each->WaitFor("motor: moves"));
  EXPECT_THAT(Runnel("stop --app third").text, AllOf(HasSubstr("third ("), Not(HasSubstr("first ("))));
  EXPECT_TRUE(third.WaitFor("/third/motor: stands"));
  second.Send(SIGSTOP);
  const Ended ended = Runnel("stop");
  EXPECT_EQ(ended.code, kRunFailed);
  EXPECT_THAT(ended.text,
              AllOf(HasSubstr("first ("), HasSubstr("): STOP is in force;"), HasSubstr("): STOP is in force already;"),
                    HasSubstr("error: the STOP is not confirmed: ")));
  EXPECT_TRUE(first.WaitFor("/first/motor: stands"));
  second.Send(SIGCONT);
  EXPECT_THAT(Runnel("release --app first").text, HasSubstr("released the STOP"));
  EXPECT_EQ(Runnel("release").code, kRunFailed) << "of which one must be said";
}

// At the answer the next process knows of it already.
TEST_F(StopCommand, OutlivesAProcessThatIsKilledAtTheAnswer) {
  const std::string run = Write("robot");
  {
    Program program(run);
    ASSERT_TRUE(program.WaitFor("/robot/motor: moves"));
    Ended stopped;
    WaitUntil("a disk that is slow has it", [&] {
      stopped = Runnel("stop");
      return stopped.code == kDone && stopped.text.find("is not written yet") == std::string::npos;
    });
    program.Send(SIGKILL);
    EXPECT_EQ(program.Wait().signal, SIGKILL);
  }
  Program next(run);
  ASSERT_TRUE(next.WaitFor("the application begins under STOP, pressed by a terminal, in a process before this one"));
  WaitUntil("it is told", [] { return Runnel("ps").text.find("running, STOP in force for") != std::string::npos; });
  EXPECT_THAT(Runnel("get /motor/speed").text, HasSubstr("0"));
  EXPECT_THAT(Runnel("release").text,
              HasSubstr("released the STOP that a terminal, in a process before this one had pressed"));
  EXPECT_TRUE(next.WaitFor("/robot/motor: moves"));
  EXPECT_EQ(Runnel("quit").code, kDone);
  EXPECT_EQ(next.Wait().code, kDone);
  Program last(run);
  EXPECT_TRUE(last.WaitFor("/robot/motor: moves")) << "what is released does not come back";
}

// Who begins without a STOP means the one of before.
TEST_F(StopCommand, ARestartDoesNotClearItAgain) {
  const std::string run = Write("robot");
  {
    Program program(run);
    ASSERT_TRUE(program.WaitFor("/robot/motor: moves"));
    ASSERT_EQ(Runnel("stop").code, kDone);
    ASSERT_EQ(Runnel("quit").code, kDone);
    EXPECT_EQ(program.Wait().code, kDone);
  }
  Program cleared(run + " --clear-stop");
  ASSERT_TRUE(cleared.WaitFor("/robot/motor: moves")) << "without the STOP of before";
  ASSERT_EQ(Runnel("stop").code, kDone);
  ASSERT_TRUE(cleared.WaitFor("/robot/motor: stands"));
  EXPECT_THAT(Runnel("restart").text, HasSubstr("runs again from its file"));
  ASSERT_TRUE(
      cleared.WaitFor("the application begins under STOP, pressed by a terminal, in a process before this one"));
  WaitUntil("it runs again", [] { return Runnel("ps").text.find("running, STOP in force for") != std::string::npos; });
}

TEST_F(StopCommand, APauseSaysWhichDrivingPortsHaveTheirSafeValueAndWhichKeepTheirLastCommand) {
  Program program(Write("robot"));
  ASSERT_TRUE(program.WaitFor("/robot/motor: moves"));
  const Ended feeds = Runnel("pause /commander");
  EXPECT_EQ(feeds.code, kDone) << feeds.text;
  EXPECT_EQ(feeds.text,
            "paused /commander; driving ports with the safe value of supervision now: /robot/motor/input/speed\n");
  ASSERT_TRUE(program.WaitFor("/robot/motor: stands"));
  const Ended drives = Runnel("pause /other");
  EXPECT_EQ(drives.code, kDone) << "what was asked for is done";
  EXPECT_THAT(drives.text, AllOf(HasSubstr("/robot/other/input/speed: cannot be reached: /robot/other is paused"),
                                 HasSubstr("keeps its last command, and has to come to rest by its own time-out"),
                                 HasSubstr("paused /other")));
  EXPECT_EQ(Runnel("resume /other").text, "resumed /other\n");
}

TEST_F(StopCommand, WhereNothingDrivesItDoesNotSucceedAndSaysWhy) {
  const std::string file = folder_ / "still.xml";
  std::ofstream(file)
      << R"(<application name="still"> <load plugin="faulty"/> <clock type="real"/> <thread name="main" period="5ms"/>
  <module name="commander" type="faulty/counter"/> </application>)";
  Program program("run --quiet " + file);
  WaitUntil("it runs", [&] { return Runnel("ps").text.find("still") != std::string::npos; });
  const Ended stopped = Runnel("stop");
  EXPECT_EQ(stopped.code, kRunFailed);
  EXPECT_THAT(stopped.text, AllOf(HasSubstr("STOP is in force;"),
                                  HasSubstr("STOP stops nothing, and the robot may move; use its own stop"),
                                  HasSubstr("<driving port=")));
  EXPECT_THAT(Runnel("ps").text, HasSubstr("but NO PORT DRIVES"));
}

// Nobody takes the connections that wait there, and there is no room for another one.
TEST_F(StopCommand, DoesNotWaitLongForAProcessThatHangs) {
  Program program(Write("robot"));
  ASSERT_TRUE(program.WaitFor("/robot/motor: moves"));
  program.Send(SIGSTOP);
  std::filesystem::path socket;
  for (const auto& each : std::filesystem::directory_iterator(folder_ / "runnel")) {
    if (each.path().extension() == ".sock") socket = each.path();
  }
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  socket.string().copy(address.sun_path, sizeof address.sun_path - 1);
  std::vector<int> waiting;
  do {
    waiting.push_back(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  } while (connect(waiting.back(), reinterpret_cast<sockaddr*>(&address), sizeof address) == 0);
  EXPECT_EQ(errno, EAGAIN);
  const Ended stopped = Runnel("stop");
  EXPECT_EQ(stopped.code, kRunFailed);
  EXPECT_THAT(stopped.text, AllOf(HasSubstr("the STOP is not confirmed"), HasSubstr("it does not answer")));
  for (const int each : waiting) close(each);
  program.Send(SIGCONT);
}

TEST_F(StopCommand, NeedsNothingThatIsInstalledAndSaysWhenNothingRuns) {
  const Ended nothing = Runnel("stop");
  EXPECT_EQ(nothing.code, kRunFailed);
  EXPECT_THAT(nothing.text, HasSubstr("no application is running that could be reached, so nothing has been stopped"));
  Program program(Write("robot"));
  ASSERT_TRUE(program.WaitFor("/robot/motor: moves"));
  std::ofstream(folder_ / "broken.extension.xml") << "<extens";
  const std::string broken = "env RUNNEL_PLUGIN_PATH=" + folder_.path().string() + " " RUNNEL_PROGRAM;
  EXPECT_EQ(Program("ps", broken).Wait().code, kBadInput);
  EXPECT_EQ(Program("stop", broken).Wait().code, kDone);
  EXPECT_TRUE(program.WaitFor("/robot/motor: stands"));
  EXPECT_THAT(Runnel("stop --app robt").text, HasSubstr("no application called 'robt' is running"));
}

TEST_F(StopCommand, APathIsRefusedWithWhatStopsThatAlone) {
  const Ended ended = Runnel("stop /robot");
  EXPECT_EQ(ended.code, kBadInput);
  EXPECT_THAT(ended.text, HasSubstr("'runnel pause PATH' leaves modules out of cycles, 'runnel block PORT'"));
}

}  // namespace
}  // namespace runnel::test

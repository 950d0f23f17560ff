// How a run ends: by signals, by faults, by monitors, by output that nobody takes.

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "tests/integration/program.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// What each test's own files are called.
std::filesystem::path TestFile(const std::string& extension) {
  return std::filesystem::path(testing::TempDir()) /
         (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + extension);
}

/// An application of faulty modules in a file that lives as long as the object.
class RunEnd : public testing::Test {
 protected:
  void TearDown() override {
    std::filesystem::remove(file_);
    std::filesystem::remove(picture_);
  }
  std::string Write(const std::string& clock, const std::string& thread, const std::string& modules) {
    std::ofstream(file_) << "<application name=\"app\">\n<load plugin=\"faulty\"/>\n"
                         << clock << "\n<thread name=\"main\" " << thread << "/>\n"
                         << modules << "\n</application>\n";
    return file_.string() + " ";
  }

  const std::string real_ = "<clock type=\"real\"/>";
  const std::string simulated_ = "<clock type=\"simulated\" speed=\"0\"/>";
  const std::filesystem::path file_ = TestFile(".xml");
  const std::filesystem::path picture_ = TestFile(".svg");
};

TEST_F(RunEnd, ComesAfterWarningsOfWhatRealTimeThreadsWereRefused) {
  const Ended ended = Runnel("run --duration 0.1 " +
                             Write(real_, "period='20ms' priority='5'", "<module name='a' type='faulty/worker'/>"));
  EXPECT_EQ(ended.code, kDone) << ended.text;
  EXPECT_THAT(ended.text, HasSubstr("the time is up"));
  EXPECT_THAT(ended.text, HasSubstr(file_.string() + ":4:1: warning: /app/threads/main: SCHED_FIFO with priority 5 "
                                                     "was refused"));
}

TEST_F(RunEnd, LeavesALogIfOneIsWanted) {
  const std::filesystem::path log = TestFile(".log");
  const std::string worker = "<module name='a' type='faulty/worker'><parameter name='good_cycles' value='2'/></module>";
  const std::string file = Write(simulated_, "period='20ms'", worker);
  const Ended ended = Runnel("run --duration 0.1 --log " + log.string() + " " + file);
  EXPECT_THAT(ended.text, HasSubstr("20ms  warning  /app/a: 2 cycles are enough\n"));
  std::ifstream stream(log);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_THAT(text, AllOf(HasSubstr("0.020 s  warning  /app/a: 2 cycles are enough\n"),
                          HasSubstr("/app/a: has failed: the worker is worn out")));
  std::filesystem::remove(log);

  const Ended refused = Runnel("run --duration 0.1 --log /no/such/folder/log " + file);
  EXPECT_EQ(refused.code, kBadInput);
  EXPECT_THAT(refused.text, HasSubstr("/no/such/folder/log: error: the log cannot be written"));
}

TEST_F(RunEnd, ComesAtOnceWhereThereIsNothingToRun) {
  for (const std::string& clock : {real_, simulated_}) {
    const Ended ended = Runnel("run " + Write(clock, "period='20ms'", ""));
    EXPECT_EQ(ended.code, kBadInput);
    EXPECT_THAT(ended.text, HasSubstr(file_.string() + ": error: there is nothing to run"));
  }
}

TEST_F(RunEnd, ComesWhenTheTimeIsUpAndNotAPeriodLater) {
  const Ended ended =
      Runnel("run --duration 1 " + Write(simulated_, "period='30s'", "<module name='a' type='faulty/worker'/>"));
  EXPECT_EQ(ended.code, kDone);
  EXPECT_THAT(ended.text, AllOf(HasSubstr("the time is up"), HasSubstr("simulated 1.00 s")));
}

TEST_F(RunEnd, ByAFaultIsAFailure) {
  for (const std::string& clock : {real_, simulated_}) {
    const Ended ended = Runnel("run " + Write(clock, "period='10ms'", R"(
<module name="a" type="faulty/worker"><parameter name="good_cycles" value="2"/></module>
<on_fault of="a" action="quit"/>)"));
    EXPECT_EQ(ended.code, kRunFailed);
    EXPECT_THAT(ended.text, AllOf(HasSubstr(file_.string() + ":6:1: error: /app/a: has failed: the worker is worn out"),
                                  HasSubstr("the run was ended because of a fault")));
  }
}

// The value that the first fault sets makes the second module fail: that shows that it still ran.
TEST_F(RunEnd, LeavesTimeToBringTheRobotToRestOnTheRealClock) {
  const Ended ended = Runnel("run " + Write(real_, "period='100ms'", R"(
<module name="second" type="faulty/worker"/>
<module name="first" type="faulty/worker"><parameter name="good_cycles" value="2"/></module>
<on_fault of="first" action="quit"/>
<on_fault of="first" set="second/good_cycles" value="0"/>)"));
  EXPECT_EQ(ended.code, kRunFailed);
  EXPECT_THAT(ended.text, AllOf(HasSubstr("/app/first: has failed"), HasSubstr("/app/second: has failed")));
}

TEST_F(RunEnd, ByAnySignalIsInOrder) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    std::filesystem::remove(picture_);
    Program program("run --speed 1 " + kDemo + "picture=" + picture_.string());
    EXPECT_TRUE(program.WaitFor("m to the goal"));
    program.Send(signal);
    const Ended ended = program.Wait();
    EXPECT_EQ(ended.code, kDone) << ended.text;
    EXPECT_THAT(ended.text, HasSubstr("ended by the user"));
    EXPECT_TRUE(std::filesystem::exists(picture_));
  }
}

TEST_F(RunEnd, BySignalAsSoonAsItIsHandledIsInOrder) {
  Program program("run " + Write(real_, "period='10ms'", "<module name='a' type='faulty/worker'/>"));
  program.WaitUntilHandles(SIGHUP, true);  // the last one; shells handle SIGINT, too
  program.Send(SIGINT);
  const Ended ended = program.Wait();
  EXPECT_EQ(ended.code, kDone);
  EXPECT_THAT(ended.text, HasSubstr("ended by the user"));
}

TEST_F(RunEnd, ByASecondSignalDoesNotWaitForModulesAndByAThirdForNothing) {
  Program program("run " + Write(simulated_, "period='10ms'", R"(
<module name="a" type="faulty/worker"><parameter name="hangs" value="true"/></module>)"));
  ASSERT_TRUE(program.WaitFor("has not returned from its cycle"));
  program.Send(SIGTERM);
  program.Send(SIGINT);
  program.WaitUntilHandles(SIGINT, false);
  EXPECT_EQ(program.Wait().code, kRunFailed);
}

TEST_F(RunEnd, ByASignalAfterAFaultIsStillAFailure) {
  Program program("run " + Write(real_, "period='10ms'", R"(
<module name="a" type="faulty/worker"><parameter name="good_cycles" value="2"/></module>
<on_fault of="a" action="quit"/>)"));
  EXPECT_TRUE(program.WaitFor("worn out"));
  program.Send(SIGINT);
  EXPECT_EQ(program.Wait().code, kRunFailed);
}

// Whichever of them has come first: who ends it does not want to see the robot drive again.
TEST_F(RunEnd, ByASignalWinsOverARestart) {
  for (const bool signal_is_first : {false, true}) {
    const TemporaryFolder folder;
    setenv("XDG_RUNTIME_DIR", folder.path().c_str(), 1);
    const std::string go_on = folder / "go_on";
    Program program("run --duration 5 " + Write(real_, "period='10ms'",
                                                R"(
<module name="judge" type="faulty/monitor"><parameter name="finishes_after" value=")" +
                                                    go_on + R"("/></module>)"));
    ASSERT_TRUE(program.WaitFor("going well"));
    // The system gives it to the main thread first, which looks for the file after that.
    if (signal_is_first) program.Send(SIGTERM);
    Program restart("restart");
    EXPECT_TRUE(restart.WaitFor("runs again from its file"));
    if (!signal_is_first) program.Send(SIGTERM);
    std::ofstream(go_on) << "\n";
    const Ended ended = program.Wait();
    EXPECT_EQ(ended.code, kDone) << ended.text;
    EXPECT_THAT(ended.text, AllOf(HasSubstr("ended by the user"), Not(HasSubstr("the time is up"))));
    unsetenv("XDG_RUNTIME_DIR");
  }
}

// Cycles have ended, and the application does not go.
TEST_F(RunEnd, SaysForWhatItWaitsUntilTheApplicationHasGoneAndASignalEndsItInOrder) {
  const std::string gone_after = TestFile(".gone").string();
  const std::string run = "run --duration 0.1 " + Write(simulated_, "period='10ms'",
                                                        R"(
<module name="a" type="faulty/slow_to_go"><parameter name="gone_after" value=")" +
                                                            gone_after + R"("/></module>)");
  const std::string waits =
      "the run waits for one of its modules or plugins to come to its end; Ctrl-C again ends the program";
  {
    Program program(run);
    ASSERT_TRUE(program.WaitFor(waits));
    program.Send(SIGINT);
    const Ended ended = program.Wait();
    EXPECT_EQ(ended.code, kRunFailed) << ended.text;
    EXPECT_THAT(
        ended.text,
        AllOf(HasSubstr("the time is up"),
              HasSubstr("one of its modules or plugins has still not come to its end; the program ends without it")));
  }
  Program program(run);
  ASSERT_TRUE(program.WaitFor(waits));
  std::ofstream(gone_after) << "\n";
  const Ended ended = program.Wait();
  EXPECT_EQ(ended.code, kDone) << ended.text;
  std::filesystem::remove(gone_after);
}

TEST_F(RunEnd, IsInOrderWhenNobodyReadsTheProgress) {
  const std::filesystem::path code = TestFile(".code");
  const std::string command = "(" RUNNEL_PROGRAM " run --speed 1 --duration 1.5 " + kDemo +
                              "picture=" + picture_.string() + "; echo ended with $? >" + code.string() + ") | true";
  EXPECT_EQ(std::system(command.c_str()), 0);
  std::string text;
  std::getline(std::ifstream(code), text);
  EXPECT_EQ(text, "ended with 0");
  EXPECT_TRUE(std::filesystem::exists(picture_));
  std::filesystem::remove(code);
}

TEST_F(RunEnd, IsAFailureWhenTheOutputCannotBeWritten) {
  for (const std::string& arguments : {std::string("version"), "run --fast " + kDemo + "picture="}) {
    const Ended ended = Runnel(arguments + " >/dev/full");
    EXPECT_EQ(ended.code, kRunFailed);
    EXPECT_THAT(ended.text, HasSubstr("standard output could not be written"));
  }
}

TEST_F(RunEnd, IsAFailureWhenAMonitorThrows) {
  for (const std::string& function : std::vector<std::string>{"progress", "outcome", "finish"}) {
    const Ended ended = Runnel("run --duration 1.5 " + Write(real_, "period='10ms'",
                                                             "<module name='judge' type='faulty/monitor'><parameter "
                                                             "name='throws_in' value='" +
                                                                 function + "'/></module>"));
    EXPECT_EQ(ended.code, kRunFailed) << ended.text;
    EXPECT_THAT(ended.text, HasSubstr(file_.string() +
                                      ":5:1: error: /app/judge: its run monitor has failed: "
                                      "thrown in " +
                                      function));
  }
}

TEST_F(RunEnd, NamesThePlaceOfAMonitorThatCannotFinish) {
  const Ended ended = Runnel("run --duration 0.1 " + Write(simulated_, "period='10ms'", R"(
<module name="judge" type="faulty/monitor"><parameter name="throws_in" value="nothing"/></module>)"));
  EXPECT_EQ(ended.code, kRunFailed);
  EXPECT_THAT(ended.text, HasSubstr(file_.string() + ":6:1: error: /app/judge: cannot be finished"));
}

TEST_F(RunEnd, ComesWhenTheModuleThatWouldJudgeItHasBeenStopped) {
  for (const std::string& clock : {real_, simulated_}) {
    const Ended ended = Runnel("run " + Write(clock, "period='10ms'", R"(
<module name="judge" type="faulty/monitor"><parameter name="throws_in" value="update"/></module>)"));
    EXPECT_EQ(ended.code, kRunFailed);
    EXPECT_THAT(ended.text, AllOf(HasSubstr("/app/judge: has failed: thrown in update"), HasSubstr("finished")));
  }
}

}  // namespace
}  // namespace runnel::test

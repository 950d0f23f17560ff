// The program's time while it runs: paused, stepped, sped up; and what it writes down of it.

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/integration/program.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::string kPacedDemo = std::string(RUNNEL_XML) + "/apps/bug_demo.xml picture= ";

/// Its sockets are in a folder of its own, and so is its trace.
class RunningTime : public testing::Test {
 protected:
  RunningTime() { setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1); }

  [[nodiscard]] std::string trace() const { return folder_ / "trace.json"; }
  std::string TraceText() {
    std::ifstream stream(trace());
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  static std::size_t Count(const json& events, const std::string& name) {
    return static_cast<std::size_t>(
        std::count_if(events.begin(), events.end(), [&](const json& each) { return each["name"] == name; }));
  }

  TemporaryFolder folder_;
};

TEST_F(RunningTime, ThreadsOfTheRealClockRunInOneIfAsked) {
  const std::string file = folder_ / "threads.xml";
  std::ofstream(file) << R"(<application name="threads">
    <load plugin="motion"/> <clock type="real"/>
    <thread name="fast" period="10ms"/> <thread name="slow" period="20ms"/>
    <module name="one" type="motion/command_gate" thread="fast"/>
    <module name="two" type="motion/command_gate" thread="slow"/>
    <connect from="one/allowed" to="two/wanted"/> <connect from="two/allowed" to="one/wanted"/>
  </application>)";
  const std::string run = "run " + file + " --fast --duration 10 --statistics ";
  EXPECT_EQ(Runnel(run).code, kBadInput);
  const Ended ended = Runnel(run + "--single-thread");
  EXPECT_EQ(ended.code, kDone) << ended.text;
  EXPECT_THAT(ended.text, HasSubstr("simulated 10.00 s"));
  EXPECT_THAT(ended.text, testing::ContainsRegex("threads/fast +1000 "));
  EXPECT_THAT(ended.text, testing::ContainsRegex("threads/slow +500 "));
}

TEST_F(RunningTime, IsSteppedResumedAndPausedFromOutside) {
  Program program("run --paused --fast " + kPacedDemo);
  EXPECT_TRUE(program.WaitFor("paused"));
  EXPECT_EQ(Runnel("step").text, "stands at 0.000 s\n");
  EXPECT_EQ(Runnel("step 20").text, "stands at 1.000 s\n");
  EXPECT_THAT(Runnel("speed").text, HasSubstr("as fast as it can, but paused"));
  // Nothing need run for the structure to be changed, and changed back.
  EXPECT_EQ(Runnel("set /robot/planner/cruise_speed 0.25").code, kDone);
  EXPECT_THAT(Runnel("undo").text, HasSubstr("undone: set /robot/planner/cruise_speed 0.25"));
  EXPECT_THAT(Runnel("redo").text, HasSubstr("redone: set /robot/planner/cruise_speed 0.25"));
  EXPECT_THAT(Runnel("ls /robot/planner -l").text, HasSubstr("= 0.25 m/s"));
  EXPECT_EQ(Runnel("resume").code, kDone);
  const Ended ended = program.Wait();
  EXPECT_EQ(ended.code, kDone) << ended.text;
  EXPECT_THAT(ended.text, HasSubstr("reached"));
}

TEST_F(RunningTime, DoesNotChangeWhereTheRobotGoes) {
  const auto verdict = [](const Ended& ended) {
    const std::size_t begin = ended.text.find("reached");
    EXPECT_NE(begin, std::string::npos) << ended.text;
    return ended.text.substr(begin, ended.text.find('\n', begin) - begin);
  };
  const Ended plain = Runnel("run --fast " + kPacedDemo);
  Program program("run --paused --trace " + trace() + " " + kPacedDemo);
  EXPECT_TRUE(program.WaitFor("paused"));
  EXPECT_EQ(Runnel("step 7").code, kDone);
  EXPECT_EQ(Runnel("speed 30").code, kDone);
  EXPECT_EQ(Runnel("resume").code, kDone);
  EXPECT_EQ(Runnel("pause").code, kDone);
  EXPECT_EQ(Runnel("speed 0").code, kDone);
  EXPECT_EQ(Runnel("resume").code, kDone);
  EXPECT_EQ(verdict(program.Wait()), verdict(plain));  // to the last digit
}

TEST_F(RunningTime, EndsInOrderByASignalInAPause) {
  Program program("run --paused " + kPacedDemo);
  EXPECT_TRUE(program.WaitFor("paused"));
  program.Send(SIGINT);
  const Ended ended = program.Wait();
  EXPECT_EQ(ended.code, kDone);
  EXPECT_THAT(ended.text, HasSubstr("ended by the user\nsimulated 0.00 s"));
}

TEST_F(RunningTime, IsOverAtTheEndAndBeginsAgainWhenAsked) {
  Program program("run --fast --hold --inspect=0 --duration 2 --trace " + trace() + " " + kPacedDemo);
  EXPECT_TRUE(program.WaitFor("held for viewers"));
  for (const std::string command : {"step", "pause", "resume", "speed 2", "speed"}) {
    const Ended refused = Runnel(command);
    EXPECT_EQ(refused.code, kBadInput) << command;
    EXPECT_THAT(refused.text, HasSubstr("the run has ended; 'runnel restart' runs")) << command;
  }
  EXPECT_THAT(Runnel("ps").text, HasSubstr("ended, held"));
  const std::string first = TraceText();
  const Ended again = Runnel("restart");
  EXPECT_EQ(again.code, kDone) << again.text;
  EXPECT_THAT(Runnel("ls /robot").text, HasSubstr("planner"));
  EXPECT_EQ(TraceText(), first) << "of the run before";
  EXPECT_EQ(Runnel("quit").code, kDone);
  const Ended ended = program.Wait();
  EXPECT_EQ(ended.code, kDone) << ended.text;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "trace_2.json"));
}

TEST_F(RunningTime, EndsWhenTheApplicationIsDeletedAndThatIsMeant) {
  Program program("run --paused " + kPacedDemo);
  EXPECT_TRUE(program.WaitFor("paused"));
  const Ended refused = Runnel("delete /bug_demo < /dev/null");
  EXPECT_EQ(refused.code, kBadInput);
  EXPECT_THAT(refused.text, HasSubstr("is the whole application"));
  const Ended deleted = Runnel("delete /bug_demo --yes");
  EXPECT_EQ(deleted.code, kDone) << deleted.text;
  EXPECT_THAT(program.Wait().text, HasSubstr("the application has been deleted"));
}

TEST_F(RunningTime, OnlySaysSoWhenAnotherFileWouldBeOverwritten) {
  Program program("run --paused " + kPacedDemo);
  EXPECT_TRUE(program.WaitFor("paused"));
  const std::string other = folder_ / "other.xml";
  std::ofstream(other) << "<application name=\"other\"/>";
  const Ended refused = Runnel("save " + other);
  EXPECT_EQ(refused.code, kBadInput);
  EXPECT_THAT(refused.text, HasSubstr("is the file of the application 'other', and would be lost"));
  EXPECT_EQ(Runnel("save " + other + " --overwrite").code, kDone);
  EXPECT_TRUE(std::filesystem::exists(other + "~"));
  EXPECT_EQ(Runnel("quit").code, kDone);
}

TEST_F(RunningTime, OfTheMachineCannotBePaused) {
  const std::filesystem::path file = folder_ / "real.xml";
  std::ofstream(file) << "<application name=\"app\"><load plugin=\"faulty\"/>\n"
                         "<module name=\"a\" type=\"faulty/worker\"/></application>\n";
  const Ended ended = Runnel("run --paused " + file.string());
  EXPECT_EQ(ended.code, kBadInput);
  EXPECT_THAT(ended.text, HasSubstr("real time cannot be paused; leave out --paused"));
}

TEST_F(RunningTime, IsTracedCycleByCycle) {
  const Ended ended = Runnel("run --fast --duration 2 --trace " + trace() + " " + kPacedDemo);
  EXPECT_EQ(ended.code, kDone) << ended.text;
  const json events = json::parse(TraceText());
  EXPECT_THAT(ended.text, HasSubstr("traced " + std::to_string(events.size()) + " events to "));
  EXPECT_EQ(Count(events, "cycle"), 40U);
  EXPECT_EQ(Count(events, "/bug_demo/robot/planner"), 40U);
  EXPECT_EQ(Count(events, "publish /bug_demo/robot/planner/output/twist"), 40U);
}

TEST_F(RunningTime, IsTracedUntilTheProgramIsKilled) {
  Program program("run --speed 50 --trace " + trace() + " " + kPacedDemo);
  EXPECT_TRUE(program.WaitFor("m to the goal"));
  const Ended stepped = Runnel("swap /robot/planner planning/bug1");
  EXPECT_EQ(stepped.code, kDone) << stepped.text;
  program.Send(SIGKILL);
  EXPECT_EQ(program.Wait().signal, SIGKILL);
  std::string text = TraceText();
  // It may have been killed in the midst of writing.
  if (!json::accept(text + "]")) text.resize(text.rfind(",\n"));
  const json events = json::parse(text + "]");
  EXPECT_GT(Count(events, "cycle"), 40U);
  EXPECT_EQ(Count(events, "put in /bug_demo/robot/planner (planning/bug1)"), 1U);
  EXPECT_GE(Count(events, "hold"), 1U);
}

TEST_F(RunningTime, IsNotTracedToWhereNothingCanBeWritten) {
  const Ended ended = Runnel("run --fast --trace /nowhere/trace.json " + kPacedDemo);
  EXPECT_EQ(ended.code, kBadInput);
  EXPECT_THAT(ended.text, HasSubstr("/nowhere/trace.json: error: "));
  EXPECT_THAT(ended.text, HasSubstr("cannot be written: No such file or directory"));
  const Ended full = Runnel("run --fast --duration 2 --trace /dev/full " + kPacedDemo);
  EXPECT_EQ(full.code, 1);
  EXPECT_THAT(full.text, HasSubstr("/dev/full: error: the trace could not be written: No space"));
}

}  // namespace
}  // namespace runnel::test

// Modules that never return, and modules that crash the program: they are named, and what has been recorded and logged
// can be read.

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "plugins/real_time_check/sanitizer.h"
#include "tests/integration/program.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string TextOf(const std::string& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class StuckAndCrash : public testing::Test {
 protected:
  // A worker in a thread of its own, beside a source and a sink that say what they read.
  void Write(const std::string& parameters, const std::string& rules) const {
    std::ofstream(application_) << R"(<application name="demo">
      <load plugin="faulty"/> <thread name="main" period="5ms"/> <thread name="other" period="5ms"/>
      <module name="source" type="faulty/counter"/> <module name="spare" type="faulty/counter">
        <parameter name="first" value="1000"/> </module>
      <module name="sink" type="faulty/listener"/> <connect from="source/count" to="sink/in"/>
      <module name="worker" type="faulty/worker" thread="other">)"
                                << parameters << "</module>" << rules << "</application>";
  }
  [[nodiscard]] std::string Path(const std::string& name) const { return folder_ / name; }
  [[nodiscard]] std::string Run() const { return "run --quiet --no-control " + application_; }

  TemporaryFolder folder_;
  const std::string application_ = folder_ / "demo.xml";
};

constexpr const char* kHangs = "<parameter name=\"hangs\" value=\"true\"/>";

TEST_F(StuckAndCrash, AStuckModuleIsNamedAndTheRestDoesWhatTheFileSays) {
  Write(kHangs, R"(<on_stuck of="worker" after="50ms">
                     <switch input="sink/in" from="source/count" to="spare/count"/> </on_stuck>)");
  Program program(Run());
  EXPECT_TRUE(program.WaitFor("error: /demo/worker: has not returned from its cycle for "));
  EXPECT_TRUE(program.WaitFor("is stuck; switched /demo/sink/"));
  EXPECT_TRUE(program.WaitFor("reads 1")) << "the sink has the other source";
  program.Send(SIGTERM);
  const Ended ended = program.Wait();
  EXPECT_EQ(ended.code, kRunFailed) << ended.text;
  EXPECT_THAT(ended.text, HasSubstr("/demo/worker: has still not returned; the program ends"));
}

TEST_F(StuckAndCrash, AStuckModuleCanEndTheRunAndItsRecordingIsWhole) {
  Write(kHangs, R"(<on_stuck of="." after="50ms"><quit/></on_stuck>)");
  const Ended ended = Runnel(Run() + " --record " + Path("run.mcap") + " --log " + Path("log"));
  EXPECT_EQ(ended.code, kRunFailed) << ended.text;
  EXPECT_THAT(ended.text, HasSubstr("the run was ended because of a fault"));
  EXPECT_THAT(TextOf(Path("log")), HasSubstr("/demo/worker: has not returned from its cycle"));
  const Ended info = Runnel("info " + Path("run.mcap"));
  EXPECT_EQ(info.code, kDone);
  EXPECT_THAT(info.text, AllOf(HasSubstr("/source/output/count"), HasSubstr("as its writer wanted it")));
}

TEST_F(StuckAndCrash, WhatWouldReplaceAStuckModuleIsRefusedAtOnce) {
  Write(kHangs, R"(<on_stuck of="worker" after="50ms">
                     <replace module="worker" by="faulty/worker"/> <quit/> </on_stuck>)");
  const Ended ended = Runnel(Run());
  EXPECT_EQ(ended.code, kRunFailed);
  EXPECT_THAT(ended.text, HasSubstr("one of its modules does not return from its cycle"));
}

TEST_F(StuckAndCrash, DeadlinesAreSetFromTheTerminal) {
  Write("", "");
  const auto deadline = [&](const std::string& words) { return Runnel("deadline --app demo " + words).text; };
  setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1);
  Program program("run " + application_);
  ASSERT_TRUE(program.WaitFor("reads"));
  EXPECT_EQ(deadline(""), "all others: at most 1s in a cycle\n");
  EXPECT_EQ(deadline("/worker 200ms"), "/demo/worker: at most 200ms in a cycle\n");
  EXPECT_EQ(deadline(""), "all others: at most 1s in a cycle\n/demo/worker: at most 200ms in a cycle\n");
  EXPECT_THAT(deadline("/wroker 1s"), HasSubstr("did you mean 'worker'?"));
  EXPECT_THAT(deadline("/worker soon"), HasSubstr("soon"));
  EXPECT_EQ(deadline("/worker off"), "/demo/worker: no deadline\n");
  program.Send(SIGTERM);
  EXPECT_EQ(program.Wait().code, kDone);
  unsetenv("XDG_RUNTIME_DIR");
}

constexpr const char* kSimulated = "<clock type=\"simulated\"/>";
constexpr const char* kTold = "error: /demo/worker: has not returned from its cycle for ";

TEST_F(StuckAndCrash, AStuckModuleIsNamedThoughNoRuleIsAboutIt) {
  Write(kHangs, "");
  Program program(Run());
  EXPECT_TRUE(program.WaitFor(kTold));
  program.Send(SIGINT);
  const Ended ended = program.Wait();
  EXPECT_EQ(ended.code, kRunFailed);
  EXPECT_THAT(ended.text, HasSubstr("/demo/worker: has still not returned; the program ends"));
}

TEST_F(StuckAndCrash, TheFileSaysAfterWhichTimeAModuleIsStuck) {
  Write(kHangs, "");
  std::string text = TextOf(application_);
  const auto add = [&](const std::string& to, const std::string& attribute) {
    text.insert(text.find(to) + to.size(), " stuck_after=\"" + attribute + "\"");
  };
  add("name=\"demo\"", "90min");
  add("name=\"other\"", "100ms");
  std::ofstream(application_) << text;
  setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1);
  Program program("run " + application_);
  EXPECT_TRUE(program.WaitFor(kTold)) << "that of the thread counts for its modules";
  EXPECT_THAT(Runnel("deadline --app demo").text,
              AllOf(HasSubstr("all others: at most 5400s in a cycle\n"),
                    HasSubstr("/other: at most 100ms in a cycle\n"), HasSubstr("/demo/worker has not returned for ")));
  program.Send(SIGTERM);
  EXPECT_EQ(program.Wait().code, kRunFailed);
  unsetenv("XDG_RUNTIME_DIR");
}

TEST_F(StuckAndCrash, OnASimulatedClockASecondSignalEndsWhatIsStuckInOrder) {
  Write(kHangs, kSimulated);
  Program program(Run() + " --record " + Path("run.mcap") + " --log " + Path("log"));
  EXPECT_TRUE(program.WaitFor(kTold));
  program.Send(SIGINT);
  EXPECT_TRUE(
      program.WaitFor("the run waits for /demo/worker to return from its cycle; Ctrl-C again ends the program"));
  program.Send(SIGINT);
  const Ended ended = program.Wait();
  EXPECT_EQ(ended.code, kRunFailed) << ended.text;
  EXPECT_THAT(TextOf(Path("log")), HasSubstr("/demo/worker: has not returned from its cycle"));
  const Ended info = Runnel("info " + Path("run.mcap"));
  EXPECT_EQ(info.code, kDone);
  EXPECT_THAT(info.text, HasSubstr("as its writer wanted it"));
}

TEST_F(StuckAndCrash, OnASimulatedClockAStuckModuleCanEndTheRunToo) {
  Write(kHangs, std::string(kSimulated) + R"(<on_stuck of="." after="50ms"><quit/></on_stuck>)");
  const Ended ended = Runnel(Run());
  EXPECT_EQ(ended.code, kRunFailed);
  EXPECT_THAT(ended.text, AllOf(HasSubstr(kTold), HasSubstr("is stuck; ends the run"),
                                HasSubstr("/demo/worker: has still not returned; the program ends")));
}

TEST_F(StuckAndCrash, ACallThatDoesNotEndIsNamedAndTheProgramEndsWithoutIt) {
  Write("", R"(<module name="deaf" type="faulty/deaf_worker"/> <connect from="deaf/work" to="deaf/ask"/>)");
  Program program(Run() + " --record " + Path("run.mcap"));
  EXPECT_TRUE(program.WaitFor("works for ever"));
  program.Send(SIGTERM);
  const Ended ended = program.Wait();
  EXPECT_EQ(ended.code, kRunFailed) << ended.text;
  EXPECT_THAT(ended.text,
              AllOf(HasSubstr("the run waits for a call of /demo/deaf to come to its end"),
                    HasSubstr("a call of /demo/deaf has still not come to its end; the program ends without it")));
  EXPECT_THAT(Runnel("info " + Path("run.mcap")).text, HasSubstr("as its writer wanted it"));
}

class Crashing : public StuckAndCrash, public testing::WithParamInterface<std::pair<const char*, int>> {
 protected:
  void SetUp() override {
    if (RUNNEL_UNDER_SANITIZER) GTEST_SKIP() << "a sanitizer tells of crashes itself";
  }
};

TEST_P(Crashing, NamesTheModuleAndLeavesRecordingTraceAndLogReadable) {
  const auto& [way, signal] = GetParam();
  Write(
      "<parameter name=\"good_cycles\" value=\"20\"/> <parameter name=\"crashes\" value=\"" + std::string(way) + "\"/>",
      "");
  const Ended ended = Runnel(Run() + " --record " + Path("run.mcap") + " --log " + Path("log") + " --trace " +
                             Path("trace.json") + " --crash-report " + Path("crash"));
  EXPECT_EQ(ended.signal, signal) << "it ends as it would have without";
  EXPECT_THAT(ended.text, HasSubstr("\ncrash: /demo/worker: SIG"));
  EXPECT_THAT(ended.text, HasSubstr("runnel::test::FaultyWorker::"));
  EXPECT_THAT(TextOf(Path("crash")),
              AllOf(HasSubstr("\ncrash: /demo/worker: SIG"), HasSubstr("runnel::test::FaultyWorker::")));
  EXPECT_THAT(TextOf(Path("log")),
              AllOf(HasSubstr("20 cycles are enough"), HasSubstr("/demo/worker has crashed: SIG")));
  const Ended info = Runnel("info " + Path("run.mcap"));
  EXPECT_EQ(info.code, kDone) << info.text;
  EXPECT_THAT(info.text, AllOf(HasSubstr("/source/output/count"), HasSubstr("as its writer wanted it")));
  EXPECT_FALSE(nlohmann::json::parse(TextOf(Path("trace.json")) + "]", nullptr, false).is_discarded());
}

INSTANTIATE_TEST_SUITE_P(Ways, Crashing,
                         testing::Values(std::pair("segmentation", SIGSEGV), std::pair("abort", SIGABRT),
                                         std::pair("overflow", SIGSEGV), std::pair("illegal", SIGILL)),
                         [](const auto& of) { return std::string(of.param.first); });

TEST_F(StuckAndCrash, ACrashOutsideOfCyclesIsToldToo) {
  if (RUNNEL_UNDER_SANITIZER) GTEST_SKIP() << "a sanitizer tells of crashes itself";
  Write("", "");
  Program program(Run() + " --crash-report ''");
  ASSERT_TRUE(program.WaitFor("reads"));
  program.Send(SIGABRT);
  const Ended ended = program.Wait();
  EXPECT_EQ(ended.signal, SIGABRT);
  EXPECT_THAT(ended.text, HasSubstr("\ncrash: no module, a thread outside of cycles: SIGABRT"));
}

}  // namespace
}  // namespace runnel::test

// How long modules take, and threads that come, change and stand still, from the terminal and in the file.

#include <csignal>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/integration/program.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

std::string TextOfFile(const std::string& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A counter, a relay and a listener, which says what it reads, on either clock.
class SchedulingCommands : public testing::Test {
 protected:
  SchedulingCommands() { setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1); }
  ~SchedulingCommands() override { unsetenv("XDG_RUNTIME_DIR"); }

  void Write(const std::string& more) const {
    std::ofstream(application_) << R"(<application name="demo">
  <load plugin="faulty"/>
  <thread name="main" period="5ms"/>
  <module name="source" type="faulty/counter"/>
  <module name="safe" type="faulty/counter"> <parameter name="first" value="1000000"/> </module>
  <module name="relay" type="faulty/reader"/>
  <module name="sink" type="faulty/listener"/>
  <connect from="source/count" to="relay/in"/>
  <connect from="relay/seen" to="sink/in"/>
)" << more << "</application>\n";
  }
  [[nodiscard]] std::string Path(const std::string& name) const { return folder_ / name; }

  TemporaryFolder folder_;
  const std::string application_ = folder_ / "demo.xml";
};

constexpr const char* kLatency = "  <latency from=\"source/count\" to=\"relay/seen\"/>\n";
constexpr const char* kOnSimulatedClock = "  <clock type=\"simulated\"/>\n";

TEST_F(SchedulingCommands, TopShowsTheModulesAndTheirLatency) {
  Write(kLatency);
  Program program("run --quiet " + application_);
  ASSERT_TRUE(program.WaitFor("reads"));
  const Ended top = Runnel("top --once");
  EXPECT_EQ(top.code, kDone);
  EXPECT_THAT(top.text, AllOf(HasSubstr("share/%"), HasSubstr("/demo/threads/main  /demo/source\n"),
                              HasSubstr("latency from /demo/source/output/count to "),
                              HasSubstr("by way of /demo/source, /demo/relay: last ")));
  EXPECT_EQ(Runnel("profile").text, "nothing is measured; 'profile on' begins\n") << "top has ended";
  EXPECT_EQ(Runnel("profile on").code, kDone);
  EXPECT_THAT(Runnel("profile").text, HasSubstr("/demo/sink\n"));
  EXPECT_EQ(Runnel("latency /source/count /relay/seen off").text, "measured no more\n");
  EXPECT_EQ(Runnel("latency").text, "no latency is measured\n");
  EXPECT_THAT(Runnel("latency /source/count /relay/seen").text, HasSubstr("by way of"));
  EXPECT_EQ(Runnel("latency /relay/seen /source/count").code, kBadInput);
  program.Send(SIGTERM);
  const Ended ended = program.Wait();
  EXPECT_EQ(ended.code, kDone);
  EXPECT_THAT(ended.text, HasSubstr("/demo/sink\n")) << "it was measured to the end";
}

TEST_F(SchedulingCommands, AProfileIsInTheLogAtTheEnd) {
  Write(std::string(kOnSimulatedClock) + kLatency + "  <profile/>\n");
  const Ended ended = Runnel("run --fast --duration 1 --quiet --log " + Path("log") + " " + application_);
  EXPECT_EQ(ended.code, kDone);
  EXPECT_THAT(TextOfFile(Path("log")),
              AllOf(ContainsRegex("info +share/%"), HasSubstr("/demo/relay\n"), HasSubstr("of 200 measurements")));
}

TEST_F(SchedulingCommands, ATraceHasArrowsAlongTheChain) {
  Write(std::string(kOnSimulatedClock) + kLatency);
  const Ended ended = Runnel("run --fast --duration 1 --trace " + Path("trace.json") + " " + application_);
  EXPECT_EQ(ended.code, kDone);
  std::map<std::string, int> ends;
  for (const auto& event : nlohmann::json::parse(TextOfFile(Path("trace.json")))) {
    if (event.value("cat", "") != "latency") continue;
    EXPECT_EQ(event["name"], "/demo/source/output/count to /demo/relay/output/seen");
    ++ends[event["ph"].get<std::string>()];
  }
  EXPECT_EQ(ends["s"], 200);
  EXPECT_EQ(ends["f"], 200);
}

TEST_F(SchedulingCommands, ThreadsComeChangeAndAreSaved) {
  Write("");
  Program program("run --quiet " + application_);
  ASSERT_TRUE(program.WaitFor("reads"));
  EXPECT_EQ(Runnel("create thread brisk period=2ms").code, kDone);
  EXPECT_EQ(Runnel("move /sink brisk").code, kDone);
  EXPECT_EQ(Runnel("schedule main --period 4ms").code, kDone);
  EXPECT_THAT(Runnel("ls /threads").text, AllOf(HasSubstr("every 2ms"), HasSubstr("every 4ms")));
  EXPECT_EQ(Runnel("schedule mian --period 4ms").code, kBadInput);
  EXPECT_EQ(Runnel("save " + Path("saved.xml")).code, kDone);
  EXPECT_THAT(TextOfFile(Path("saved.xml")),
              AllOf(HasSubstr("<thread name=\"main\" period=\"4ms\"/>"),
                    HasSubstr("<thread name=\"brisk\" period=\"2ms\"/>"), HasSubstr("thread=\"brisk\"")));
  EXPECT_EQ(Runnel("check " + Path("saved.xml")).code, kDone);
  EXPECT_THAT(Runnel("undo").text, HasSubstr("undone: schedule main period=4ms"));
  EXPECT_EQ(Runnel("undo").code, kDone);
  EXPECT_EQ(Runnel("undo").code, kDone);
  EXPECT_THAT(Runnel("ls /threads").text, AllOf(Not(HasSubstr("brisk")), HasSubstr("every 5ms")));
  program.Send(SIGTERM);
  EXPECT_EQ(program.Wait().code, kDone);
}

TEST_F(SchedulingCommands, APausedModuleMakesRoomForTheSafeValue) {
  Write(R"(  <on_pause of="relay">
    <switch input="sink/in" from="relay/seen" to="safe/count"/>
    <otherwise><switch input="sink/in" from="safe/count" to="relay/seen"/></otherwise>
  </on_pause>)");
  Program program("run --quiet " + application_);
  ASSERT_TRUE(program.WaitFor("reads"));
  EXPECT_EQ(Runnel("pause /relay").text, "paused /relay\n");
  EXPECT_TRUE(program.WaitFor("reads 1000"));
  EXPECT_THAT(Runnel("resume /relya").text, HasSubstr("did you mean 'relay'?"));
  EXPECT_EQ(Runnel("resume /source").code, kBadInput) << "that is not paused";
  EXPECT_EQ(Runnel("resume /relay").text, "resumed /relay\n");
  EXPECT_TRUE(program.WaitFor("goes on; switched"));
  EXPECT_EQ(Runnel("pause /threads/main").code, kDone) << "all of a thread";
  program.Send(SIGTERM);
  EXPECT_EQ(program.Wait().code, kDone);
}

// A variable of a shell that is not set must not become "all of them".
TEST_F(SchedulingCommands, AnEmptyWordIsAnError) {
  Write("");
  Program program("run --quiet " + application_);
  ASSERT_TRUE(program.WaitFor("reads"));
  ASSERT_EQ(Runnel("publish /sink/in 3").code, kDone);
  for (const std::string command : {"release",      "pause",
                                    "resume",       "block",
                                    "restart",      "ls",
                                    "hz",           "echo",
                                    "get",          "copy relay",
                                    "save",         "step",
                                    "speed",        "activities",
                                    "profile",      "deadline",
                                    "reload",       "delete",
                                    "rename relay", "disconnect source/count",
                                    "tag relay",    "record -o a.mcap",
                                    "ls --app",     "publish /sink/in 3 --rate"}) {
    const Ended refused = Runnel(command + " \"\"");
    EXPECT_EQ(refused.code, kBadInput) << command;
    EXPECT_THAT(refused.text,
                testing::AnyOf(HasSubstr("one of its words is empty; is a variable of the shell not set?"),
                               HasSubstr("an empty word names no application")))
        << command;
  }
  EXPECT_EQ(Runnel("get /sink/in").text, "3\n");
  EXPECT_THAT(Runnel("ps").text, HasSubstr("running"));
  program.Send(SIGTERM);
  EXPECT_EQ(program.Wait().code, kDone);
}

}  // namespace
}  // namespace runnel::test

// Recordings of the demo, as a user makes and replays them.

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <unistd.h>

#include "plugins/mcap/mcap_reader.h"
#include "tests/integration/program.h"
#include "tests/integration/recorded_values.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::SizeIs;

const std::string kWorlds = std::string(RUNNEL_XML) + "/worlds/";
constexpr const char* kTwist = "/bug_demo/robot/planner/output/twist";
constexpr const char* kSensors =
    " --ports laser/scan --ports localisation/pose --ports bumper/contact --ports world/goal ";

class Recording : public testing::Test {
 protected:
  [[nodiscard]] std::string Path(const std::string& name) const { return folder_ / name; }

  /// The demo in the world with one obstacle, from start to goal.
  void RecordTheDemo() {
    const Ended ended =
        Runnel("run --fast --quiet " + kDemo + "world=" + kWorlds + "one_obstacle.xml --record " + Path("run.mcap"));
    ASSERT_EQ(ended.code, kDone) << ended.text;
    ASSERT_THAT(ended.text, AllOf(HasSubstr("recorded "), HasSubstr("to " + Path("run.mcap")),
                                  testing::Not(HasSubstr("too fast"))));
  }

 private:
  TemporaryFolder folder_;
};

// A blackboard publishes in its constructor: the value bore the machine's time, so 5 s were as long as the machine was on.
TEST_F(Recording, OfOneRunIsThatOfTheNextToTheLastOctet) {
  std::vector<std::string> runs;
  for (const char* const name : {"first.mcap", "second.mcap"}) {
    const Ended ended =
        Runnel("run --fast --quiet --duration 5 " RUNNEL_XML "/apps/places_demo.xml --record " + Path(name));
    ASSERT_THAT(ended.text, AllOf(HasSubstr("recorded "), testing::Not(HasSubstr("too fast")))) << ended.code;
    const auto reader = McapReader::Open(Path(name));
    ASSERT_TRUE(reader);
    EXPECT_LE((*reader)->contents().statistics.end, 5'000'000'000u);
    std::map<std::string, std::string> ports;
    EXPECT_TRUE((*reader)->ReadMessages([&](const McapMessage& message) -> Result<void> {
      const McapChannel& channel = (*reader)->contents().channels.at(message.channel);
      std::string port = channel.topic;
      for (const auto& [key, value] : channel.metadata) port += " " + value;
      ports[port] += std::to_string(message.log_time) + " " + std::to_string(message.publish_time) + " " +
                     std::string(message.data) + "\n";
      return {};
    }));
    EXPECT_THAT(ports, testing::Contains(testing::Key(HasSubstr("/book/output/places"))));
    std::string& run = runs.emplace_back();
    for (const auto& [port, values] : ports) run += port + "\n" + values;
  }
  EXPECT_EQ(runs[0], runs[1]);
}

TEST_F(Recording, TheSensorsOfARunGiveTheSameCommandsAlsoInAnotherWorld) {
  RecordTheDemo();
  const auto recorded = ValuesOf(Path("run.mcap"), kTwist);
  ASSERT_GT(recorded.size(), 200u);
  // The world around is another one: nothing but what is played can make the planner do the same.
  const Ended ended = Runnel("replay " + Path("run.mcap") + " " + kDemo + "world=" + kWorlds +
                             "spiral.xml --rate 0 --quiet" + kSensors + "--record " + Path("again.mcap"));
  EXPECT_EQ(ended.code, kDone) << ended.text;
  EXPECT_THAT(ended.text, HasSubstr("values at 4 ports"));
  EXPECT_EQ(ValuesOf(Path("again.mcap"), kTwist), recorded);
  EXPECT_NE(ValuesOf(Path("again.mcap"), "/bug_demo/world/sensor_output/pose"),
            ValuesOf(Path("run.mcap"), "/bug_demo/world/sensor_output/pose"));
}

TEST_F(Recording, InfoSaysWhatIsInIt) {
  RecordTheDemo();
  const Ended text = Runnel("info " + Path("run.mcap"));
  EXPECT_EQ(text.code, kDone);
  EXPECT_THAT(text.text,
              AllOf(HasSubstr("bug_demo.xml"), HasSubstr("clock        simulated"), HasSubstr("one_obstacle.xml"),
                    HasSubstr("20.0"), HasSubstr("/bug_demo/laser/output/scan"), HasSubstr("RangeScan")));
  const Ended json = Runnel("info --json " + Path("run.mcap"));
  EXPECT_EQ(json.code, kDone);
  EXPECT_THAT(json.text, HasSubstr("\"ended_properly\":true"));
}

TEST_F(Recording, IsReplayedWithoutItsApplication) {
  RecordTheDemo();
  const Ended ended = Runnel("replay " + Path("run.mcap") + " --rate 0 --quiet --record " + Path("again.mcap"));
  EXPECT_EQ(ended.code, kDone) << ended.text;
  EXPECT_THAT(ended.text, HasSubstr("replayed "));
  ASSERT_GT(ValuesOf(Path("run.mcap"), kTwist).size(), 200u);
  for (const char* port : {"/bug_demo/localisation/output/pose", "/bug_demo/laser/output/scan", kTwist}) {
    EXPECT_EQ(ValuesOf(Path("again.mcap"), port), ValuesOf(Path("run.mcap"), port)) << port;
  }
}

TEST_F(Recording, IsReplayedIntoWhatComesWithRunnelByItsName) {
  RecordTheDemo();
  const std::string replay = "replay " + Path("run.mcap") + " ";
  const Ended ended = Runnel(replay + "bug_demo world=" + kWorlds + "one_obstacle.xml --rate 0 --quiet" + kSensors +
                             "--record " + Path("again.mcap"));
  EXPECT_EQ(ended.code, kDone) << ended.text;
  EXPECT_THAT(ended.text, HasSubstr("values at 4 ports"));
  EXPECT_EQ(ValuesOf(Path("again.mcap"), kTwist), ValuesOf(Path("run.mcap"), kTwist));
  const Ended wrong = Runnel(replay + "bug_demos --rate 0");
  EXPECT_EQ(wrong.code, kBadInput);
  EXPECT_THAT(wrong.text, HasSubstr("bug_demos"));
}

TEST_F(Recording, PlaysAStretchFromLaterOn) {
  RecordTheDemo();
  const Ended ended = Runnel("replay " + Path("run.mcap") + " " + kDemo +
                             " --rate 0 --quiet --from 2 --to 3 --ports laser/scan --record " + Path("again.mcap") +
                             " --record-ports laser/scan");
  EXPECT_EQ(ended.code, kDone) << ended.text;
  EXPECT_THAT(ended.text, HasSubstr("replayed 1s: 2"));
}

TEST_F(Recording, OfARunningApplicationEndsWithCtrlCInOrder) {
  setenv("XDG_RUNTIME_DIR", Path("").c_str(), 1);
  Program application("run " + kDemo + "--speed 5 --quiet");
  const std::string app = " --app bug_demo ";
  std::string refused;
  do {
    refused = Runnel("record" + app + "-o " + Path("no.mcap") + " laser/scam").text;
  } while (refused.find("no application is running") != std::string::npos);
  EXPECT_THAT(refused, HasSubstr("there is no port 'laser/scam' to record"));
  EXPECT_FALSE(std::filesystem::exists(Path("no.mcap")));

  Program recording("record" + app + "-o " + Path("live.mcap") + " laser/scan '*/pose'");
  WaitUntil("the first chunk is written", [&] {
    return std::filesystem::exists(Path("live.mcap")) && std::filesystem::file_size(Path("live.mcap")) > 10'000;
  });
  recording.Send(SIGINT);
  const Ended ended = recording.Wait();
  EXPECT_EQ(ended.code, kDone) << ended.text;
  EXPECT_THAT(ended.text, HasSubstr("recorded "));
  EXPECT_GT(ValuesOf(Path("live.mcap"), "/bug_demo/laser/output/scan").size(), 3u);

  const Ended again = Runnel("record" + app + "-o " + Path("live.mcap"));
  EXPECT_EQ(again.code, kBadInput);
  EXPECT_THAT(again.text, HasSubstr("live.mcap: error: cannot be made: File exists"));
  application.Send(SIGINT);
  EXPECT_EQ(application.Wait().code, kDone);
  unsetenv("XDG_RUNTIME_DIR");
}

TEST_F(Recording, AModuleRecordsWhatTheApplicationFileSays) {
  std::ifstream demo(std::string(RUNNEL_XML) + "/apps/bug_demo.xml");
  std::string text{std::istreambuf_iterator<char>(demo), {}};
  text.insert(text.find("  <clock"), "  <load plugin=\"recording\"/>\n");
  text.insert(text.find("  <module name=\"referee\""),
              "<module name=\"recorder\" type=\"recording/recorder\">"
              "<parameter name=\"file\" value=\"here.mcap\"/>"
              "<parameter name=\"ports\" value=\"world/* !**/twist\"/></module>\n");
  std::ofstream(Path("app.xml")) << text;
  const std::string run = "run --fast --quiet " + Path("app.xml") + " world=" + kWorlds + "one_obstacle.xml";
  const Ended ended = Runnel(run);
  EXPECT_EQ(ended.code, kDone) << ended.text;
  const auto poses = ValuesOf(Path("here.mcap"), "/bug_demo/world/sensor_output/pose");
  ASSERT_GT(poses.size(), 200u);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    ASSERT_THAT(poses[i], testing::StartsWith(std::to_string(i * 50'000'000) + " "));
  }
  EXPECT_THAT(ValuesOf(Path("here.mcap"), "/bug_demo/world/sensor_output/twist"), SizeIs(0));
  const Ended again = Runnel(run);
  EXPECT_EQ(again.code, kBadInput);
  EXPECT_THAT(again.text, HasSubstr("cannot be made: File exists"));
}

TEST_F(Recording, SaysWhatIsWrongWithFiles) {
  const Ended missing = Runnel("info " + Path("none.mcap"));
  EXPECT_EQ(missing.code, kBadInput);
  EXPECT_THAT(missing.text, HasSubstr("none.mcap: error: cannot be read: No such file"));
  const Ended folder = Runnel("run --fast " + kDemo + "--record /nowhere/run.mcap");
  EXPECT_EQ(folder.code, kBadInput);
  EXPECT_THAT(folder.text, HasSubstr("make its folder first"));
  RecordTheDemo();
  std::filesystem::resize_file(Path("run.mcap"), std::filesystem::file_size(Path("run.mcap")) / 2);
  const Ended cut = Runnel("info " + Path("run.mcap"));
  EXPECT_EQ(cut.code, kRunFailed);
  EXPECT_THAT(cut.text, AllOf(HasSubstr("end          missing"), HasSubstr("at byte ")));
  const Ended replayed = Runnel("replay " + Path("run.mcap") + " " + kDemo + "--rate 0 --quiet --ports laser/scan");
  EXPECT_EQ(replayed.code, kDone) << replayed.text;
  EXPECT_THAT(replayed.text, HasSubstr("warning: played is what comes before its damage"));
}

}  // namespace
}  // namespace runnel::test

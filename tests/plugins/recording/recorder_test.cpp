#include "plugins/recording/recorder.h"

#include <csignal>
#include <filesystem>
#include <thread>

#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/module/group.h"
#include "core/plugin/module_registry.h"
#include "plugins/recording/recording_names.h"
#include "plugins/structure/structure_editor.h"
#include "plugins/values/json_values.h"
#include "tests/plugins/recording/recording_fixture.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;
using RecorderTest = RecordingTest;

TEST_F(RecorderTest, RecordsEachValueWithItsTimeAndWhatItIs) {
  Application application;
  const std::string file = Record("a.mcap", application, milliseconds(30));
  EXPECT_THAT(ValuesOf(file, "/sink/output/sum"), SizeIs(3));
  const auto samples = ValuesOf(file, "/source/output/sample");
  ASSERT_THAT(samples, SizeIs(3));
  EXPECT_THAT(samples[1], testing::StartsWith("10000000 {\"values\":["));
  EXPECT_THAT(samples[2], HasSubstr("\"name\":\"n3\"}"));
  const auto reader = Must(McapReader::Open(file));
  EXPECT_TRUE(reader->contents().ended_properly);
  for (const auto& [id, channel] : reader->contents().channels) {
    if (PortOf(channel) != "/source/output/sample") continue;
    EXPECT_EQ(channel.topic, "/sample");
    EXPECT_EQ(channel.message_encoding, "json");
    const McapSchema& schema = reader->contents().schemas.at(channel.schema);
    EXPECT_EQ(schema.name, "test::Sample");
    EXPECT_EQ(schema.encoding, "jsonschema");
    EXPECT_EQ(schema.data, JsonSchemaOf(TypeOf<Sample>()));
  }
}

/// Says what it has counted to.
class Talker final : public Module {
 public:
  using Module::Module;

 private:
  void Update() override { log().Warn("cycle {}", ++count_); }
  int count_ = 0;
};

TEST_F(RecorderTest, RecordsWhatModulesSay) {
  Application application;
  auto& talker = application.runtime.Create<Talker>(application.runtime.root(), "talker");
  Must(application.runtime.MakeReady(talker));
  const std::string file = Record("a.mcap", application, milliseconds(30), {"number"});
  auto reader = Must(McapReader::Open(file));
  std::vector<std::string> said;
  Must(reader->ReadMessages([&](const McapMessage& message) -> Result<void> {
    const McapChannel& channel = reader->contents().channels.at(message.channel);
    if (channel.topic != "/log") return {};
    EXPECT_TRUE(IsView(channel)) << "nobody replays what was said";
    said.push_back(std::to_string(message.log_time) + " " + std::string(message.data));
    return {};
  }));
  ASSERT_THAT(said, SizeIs(3));
  EXPECT_EQ(said[1], R"(10000000 {"timestamp":{"sec":0,"nsec":10000000},"level":3,)"
                     R"("message":"cycle 2","name":"/talker","file":"","line":0})");
}

TEST_F(RecorderTest, TellsApartWhenAValueWasPublishedAndWhenItWasMeasured) {
  Runtime runtime;
  auto& source = runtime.Create<Source>(runtime.root(), "source");
  Must(runtime.MakeReady(runtime.root()));
  auto recorder = Must(Recorder::Start(runtime, nullptr, {.file = Path("a.mcap"), .ports = {"number"}}));
  {
    const CycleScope cycle({.now = Time(milliseconds(30))});
    source.number.Publish(1, Time(milliseconds(10)));
    source.number.Publish(2);
  }
  Must(recorder->Finish());
  auto reader = Must(McapReader::Open(Path("a.mcap")));
  std::vector<std::pair<std::uint64_t, std::uint64_t>> times;
  Must(reader->ReadMessages([&](const McapMessage& message) -> Result<void> {
    times.emplace_back(message.log_time, message.publish_time);
    return {};
  }));
  EXPECT_THAT(times, ElementsAre(std::pair(30'000'000u, 10'000'000u), std::pair(30'000'000u, 30'000'000u)));
}

TEST_F(RecorderTest, OfASimulatedRunNothingIsMissingHoweverFastItGoes) {
  Application application;
  const std::string file = Record("fast.mcap", application, seconds(200));
  const auto sums = ValuesOf(file, "/sink/output/sum");
  ASSERT_THAT(sums, SizeIs(20'000));
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const std::string time = std::to_string(i * 10'000'000) + " ";
    ASSERT_THAT(sums[i], testing::StartsWith(time));
  }
}

TEST_F(RecorderTest, WhatTheApplicationComputesDoesNotDependOnIt) {
  Application alone, recorded;
  alone.Run(seconds(2));
  (void)Record("a.mcap", recorded, seconds(2));
  const auto last = [](Application& application) {
    double sum = 0;
    application.sink->sum.VisitLatest([&](const void* value, Time) { sum = *static_cast<const double*>(value); });
    return sum;
  };
  EXPECT_EQ(last(alone), last(recorded));
  EXPECT_TRUE(recorded.source->number.outgoing().size() == 1) << "nothing is left of the recorder";
}

TEST_F(RecorderTest, RecordsWhatFitsAndSaysWhatCannotBeWritten) {
  Application application;
  auto recorder = Must(Recorder::Start(application.runtime, &application.scheduler,
                                       {.file = Path("a.mcap"), .ports = {"/source/*", "/sorce/*", "!sample"}}));
  application.Run(milliseconds(20));
  Must(recorder->Finish());
  EXPECT_THAT(recorder->status().left_out, ElementsAre("/source/output/secret"));
  EXPECT_THAT(recorder->status().idle_patterns, ElementsAre("/sorce/*"));
  EXPECT_EQ(recorder->status().values, 2u);
  EXPECT_EQ(recorder->status().ports, 1u);
  EXPECT_THAT(ValuesOf(Path("a.mcap"), "/source/output/number"), SizeIs(2));
}

TEST_F(RecorderTest, ANameThatIsNotThereIsAnErrorAndNoFileIsMade) {
  Application application;
  const auto start = [&](const std::string& port) {
    const auto started = Recorder::Start(application.runtime, nullptr, {.file = Path("a.mcap"), .ports = {port}});
    EXPECT_FALSE(std::filesystem::exists(Path("a.mcap")));
    return started ? std::string("started") : started.error().ToString();
  };
  EXPECT_THAT(start("/source/numbr"), HasSubstr("did you mean '/source/number'?"));
  EXPECT_THAT(start("/sink/sample"), HasSubstr("is an input; recorded is what outputs publish; "
                                               "record /source/sample"));
  EXPECT_THAT(start("/source/secret"), HasSubstr("values of type test::Secret have no form"));
}

TEST_F(RecorderTest, FollowsModulesThatComeAndGo) {
  Application application;
  auto recorder = Must(
      Recorder::Start(application.runtime, &application.scheduler, {.file = Path("a.mcap"), .ports = {"**/number"}}));
  application.Run(milliseconds(20));
  auto& late = application.runtime.Create<Source>(application.runtime.root(), "late");
  Must(application.runtime.MakeReady(late));
  application.Run(milliseconds(30));
  Must(application.runtime.Delete(late));
  application.Run(milliseconds(10));
  auto& again = application.runtime.Create<Source>(application.runtime.root(), "late");
  Must(application.runtime.MakeReady(again));
  application.Run(milliseconds(20));
  Must(recorder->Finish());
  EXPECT_THAT(ValuesOf(Path("a.mcap"), "/source/output/number"), SizeIs(8));
  EXPECT_THAT(ValuesOf(Path("a.mcap"), "/late/output/number"), SizeIs(5));
  EXPECT_THAT(Must(McapReader::Open(Path("a.mcap")))->contents().channels, SizeIs(2))
      << "what comes back goes on in its channel";
}

TEST_F(RecorderTest, WhatIsRenamedGoesOnUnderItsNewNameAndItsOldNameIsFree) {
  Application application;
  ModuleRegistry registry;
  Must(registry.Add({"test/source", "", "test", [](const Placement& placement) {
                       return std::unique_ptr<FrameworkElement>(std::make_unique<Source>(placement));
                     }}));
  StructureEditor editor(application.runtime, registry, &application.scheduler);
  const auto change = [&](const ChangeSet& changes) {
    const ChangeOutcome outcome = editor.Apply(changes);
    ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
  };
  application.runtime.Create<Group>(application.runtime.root(), "app");
  change({CreateModule{"/app/first", "test/source"}});
  auto recorder = Must(
      Recorder::Start(application.runtime, &application.scheduler, {.file = Path("a.mcap"), .ports = {"**/number"}}));
  application.Run(milliseconds(30));
  change({RenameElement{"/app/first", "second"}});
  change({CreateModule{"/app/first", "test/source"}});
  application.Run(milliseconds(40));
  Must(recorder->Finish());
  EXPECT_EQ(recorder->status().dropped, 0u);
  EXPECT_THAT(ValuesOf(Path("a.mcap"), "/app/first/output/number"), SizeIs(7)) << "3 of one, 4 of the other";
  EXPECT_THAT(ValuesOf(Path("a.mcap"), "/app/second/output/number"), SizeIs(5)) << "the newest one of before, too";
}

TEST_F(RecorderTest, CountsWhatComesTooFastOnARealClock) {
  Runtime runtime;
  auto& source = runtime.Create<Source>(runtime.root(), "source");
  Must(runtime.MakeReady(runtime.root()));
  auto recorder = Must(Recorder::Start(runtime, nullptr, {.file = Path("a.mcap"), .ports = {"number"}, .capacity = 4}));
  constexpr int kValues = 50'000;
  for (int i = 0; i < kValues; ++i) source.number.Publish(i);
  Must(recorder->Finish());
  const RecordingStatus status = recorder->status();
  EXPECT_EQ(status.values + status.dropped, static_cast<std::uint64_t>(kValues));
  EXPECT_GT(status.dropped, 0u);
  const auto reader = Must(McapReader::Open(Path("a.mcap")));
  std::string told;
  for (const auto& metadata : reader->contents().metadata) {
    if (metadata.name == kDropsMetadata) told = metadata.texts.at(0).second;
  }
  EXPECT_EQ(told, std::to_string(status.dropped));
}

// A limit on the size of files stands for a full disk.
TEST_F(RecorderTest, AFullDiskEndsTheRecordingAndNotTheApplication) {
  Application application;
  auto recorder = Must(Recorder::Start(application.runtime, &application.scheduler, {.file = Path("a.mcap")}));
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit small = before;
  small.rlim_cur = 800'000;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  application.Run(seconds(2000));
  const auto finished = recorder->Finish();
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, old_handler);
  ASSERT_FALSE(finished);
  EXPECT_THAT(finished.error().ToString(), HasSubstr("a.mcap: cannot be written on"));
  EXPECT_TRUE(recorder->TakeFailure());
  EXPECT_FALSE(recorder->TakeFailure()) << "told once";
  EXPECT_EQ(application.runtime.clock().Now(), Time(seconds(2000)));
  EXPECT_FALSE(Must(McapReader::Open(Path("a.mcap")))->contents().ended_properly);
  std::uint64_t written = 0;
  for (const char* port : {"/source/output/number", "/source/output/sample", "/sink/output/sum"}) {
    written += ValuesOf(Path("a.mcap"), port).size();
  }
  const RecordingStatus status = recorder->status();
  EXPECT_GT(written, 0u);
  EXPECT_EQ(status.values, written);
  EXPECT_EQ(status.values + status.dropped, 3 * 200'000u) << "nothing is both or neither";
}

TEST_F(RecorderTest, OfAKilledProcessAllButTheLastSecondIsThere) {
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    Runtime runtime;
    auto& source = runtime.Create<Source>(runtime.root(), "source");
    (void)runtime.MakeReady(runtime.root());
    auto recorder = Recorder::Start(runtime, nullptr, {.file = Path("a.mcap"), .ports = {"number"}});
    for (int i = 0; i < 100; ++i) source.number.Publish(i);
    // The chunk is written within a second and a little.
    while (recorder && !Must(McapReader::Open(Path("a.mcap")))->contents().statistics.messages) {
      std::this_thread::sleep_for(milliseconds(20));
    }
    source.number.Publish(100);
    (void)!write(ready[1], "x", 1);
    for (;;) pause();
  }
  pollfd written{ready[0], POLLIN, 0};
  const auto longest = std::chrono::milliseconds(kLongestWait).count();
  const int is_written = poll(&written, 1, static_cast<int>(longest));
  ASSERT_EQ(kill(child, SIGKILL), 0);
  EXPECT_EQ(is_written, 1) << "waited in vain until the child had written its first second";
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  const auto reader = Must(McapReader::Open(Path("a.mcap")));
  EXPECT_FALSE(reader->contents().ended_properly);
  EXPECT_EQ(reader->contents().statistics.messages, 100u);
}

}  // namespace
}  // namespace runnel::test

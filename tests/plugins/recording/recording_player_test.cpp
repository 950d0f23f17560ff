#include "plugins/recording/recording_player.h"

#include <map>

#include "plugins/structure/change.h"
#include "plugins/values/json_values.h"
#include "tests/plugins/recording/recording_fixture.h"

namespace runnel::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;

const std::string kNumberSchema = ChannelsFor(TypeOf<double>(), "", WholeValues()).front().schema;

class RecordingPlayerTest : public RecordingTest {
 protected:
  static Result<std::unique_ptr<Player>> Play(Application& application, const std::string& file,
                                              const PlayerOptions& options = {}) {
    return Player::Prepare(application.runtime, Must(McapReader::Open(file)), options);
  }
  /// The connections that a file has which is saved meanwhile, of what is played.
  static std::string Saved(Application& application) {
    std::string text;
    for (const ChangeSet& back : application.runtime.root().FindAnnotation<SwitchedByRules>()->all.back()()) {
      for (const Change& each : back)
        text += std::get<ConnectPorts>(each).from + " " + std::get<ConnectPorts>(each).to + "\n";
    }
    return text;
  }
};

TEST_F(RecordingPlayerTest, WhatReadsThePlayedPublishesTheSameBitForBitAtTheSameTimes) {
  Application recorded;
  const std::string file = Record("a.mcap", recorded, seconds(20));
  Application other;
  other.source->factor = 0.7;  // without the player, the sink would publish something else
  auto player = Must(Play(other, file, {.ports = {"/source/*"}}));
  player->Start(other.runtime.clock().Now());
  const std::string again = Record("b.mcap", other, seconds(20), {"**/sum"});
  EXPECT_EQ(ValuesOf(again, "/sink/output/sum"), ValuesOf(file, "/sink/output/sum"));
  EXPECT_TRUE(player->is_over());
  EXPECT_FALSE(player->failure());
  EXPECT_EQ(player->published(), 4000u);
}

TEST_F(RecordingPlayerTest, PlayedValuesWereMeasuredAsLongBeforeTheirPublicationAsRecorded) {
  auto writer = Must(McapWriter::Create(Path("lag.mcap"), {}));
  const auto schema = Must(writer->AddSchema("double", "jsonschema", kNumberSchema));
  const auto channel =
      Must(writer->AddChannel(schema, "/source/number", "json", {{kPortKey, "/source/output/number"}}));
  Must(writer->AddMessage({channel, 0, 20'000'000, 5'000'000, "{\"value\":1}"}));
  Must(writer->Finish());
  Application application;
  auto player = Must(Play(application, Path("lag.mcap")));
  player->Start(Time(milliseconds(50)));
  application.Run(milliseconds(100));
  EXPECT_TRUE(application.sink->number.VisitLatest([](const void*, ValueTimes times) {
    EXPECT_EQ(times.publication_time, Time(milliseconds(50)));
    EXPECT_EQ(times.timestamp, Time(milliseconds(35)));
  }));
}

TEST_F(RecordingPlayerTest, WithoutThePlayerItWouldBeDifferent) {
  Application recorded, other;
  other.source->factor = 0.7;
  const std::string file = Record("a.mcap", recorded, seconds(1), {"**/sum"});
  const std::string again = Record("b.mcap", other, seconds(1), {"**/sum"});
  EXPECT_NE(ValuesOf(again, "/sink/output/sum"), ValuesOf(file, "/sink/output/sum"));
}

TEST_F(RecordingPlayerTest, AModuleRunsOnIfSomethingElseOfItIsRead) {
  Application recorded;
  const std::string file = Record("a.mcap", recorded, seconds(1));
  Application both, one;
  auto all = Must(Play(both, file, {.ports = {"/source/*"}}));
  auto some = Must(Play(one, file, {.ports = {"/source/number"}}));
  all->Start(Time{});
  some->Start(Time{});
  both.Run(milliseconds(100));
  one.Run(milliseconds(100));
  EXPECT_EQ(both.source->secret.publications(), 0u) << "all that is read of it is played";
  EXPECT_EQ(both.source->number.publications(), 10u) << "viewers find the values where they were";
  EXPECT_EQ(one.source->secret.publications(), 10u);
  EXPECT_EQ(one.source->number.publications(), 10u) << "into a channel that nobody reads";
  EXPECT_EQ(one.source->number.outgoing().size(), 0u);
}

TEST_F(RecordingPlayerTest, AMarkThatIsNotZeroGoesAlong) {
  Application recorded, other;
  const std::string file = Record("a.mcap", recorded, seconds(1));
  Port& number = other.source->number;
  Must(number.SetDriving(true, AnyValue(0.3)));
  const auto player = Must(Play(other, file, {.ports = {"/source/number"}}));
  EXPECT_EQ(number.outgoing().size(), 0u);
  other.runtime.robot_stop().Press("a test");
  EXPECT_EQ(other.sink->number.Get(), 0.3);
}

TEST_F(RecordingPlayerTest, AFileThatIsSavedMeanwhileKeepsTheConnections) {
  Application recorded, other;
  const std::string file = Record("a.mcap", recorded, seconds(1));
  auto player = Must(Play(other, file, {.ports = {"/source/number"}}));
  EXPECT_EQ(Saved(other), "/source/output/number /sink/input/number\n");
  player.reset();
  EXPECT_EQ(Saved(other), "");
}

// As a task of a component that has a thread of its own.
struct Below final : Module {
  using Module::Module;
  int cycles = 0;
  void Update() override { ++cycles; }
};

TEST_F(RecordingPlayerTest, WhatIsBelowAModuleThatRestsRestsToo) {
  Application recorded;
  const std::string file = Record("a.mcap", recorded, seconds(1));
  for (const auto& [ports, cycles] : std::map<std::string, int>{{"/source/*", 0}, {"/source/number", 10}}) {
    Application other;
    auto& below = other.runtime.Create<Below>(*other.source, "below");
    Must(other.runtime.MakeReady(below));
    const auto player = Must(Play(other, file, {.ports = {ports}}));
    player->Start(Time{});
    other.Run(milliseconds(100));
    EXPECT_EQ(below.cycles, cycles) << ports;
  }
}

TEST_F(RecordingPlayerTest, AModuleWhosePortsArePlayedMayBeDeletedMeanwhile) {
  Application recorded;
  const std::string file = Record("a.mcap", recorded, seconds(1));
  for (const auto& [ports, published] : std::map<std::string, unsigned>{{"/source/*", 10u}, {"/source/number", 5u}}) {
    Application other;
    const auto player = Must(Play(other, file, {.ports = {ports}}));
    player->Start(Time{});
    other.Run(milliseconds(50));
    EXPECT_EQ(player->published(), published);
    Must(other.runtime.Delete(*other.source));
    other.Run(milliseconds(50));
    EXPECT_EQ(player->published(), published) << "its tasks have gone with it: " << ports;
    EXPECT_FALSE(player->failure());
    EXPECT_EQ(Saved(other), "") << ports;
  }
}

// Of what came to the sink's input: times in ns, and what was said then.
void WriteInputs(const std::string& file, const std::vector<std::pair<std::uint64_t, std::string>>& values) {
  auto writer = Must(McapWriter::Create(file, {}));
  const auto schema = Must(writer->AddSchema("double", "jsonschema", kNumberSchema));
  const auto channel = Must(writer->AddChannel(schema, "/sink/input/number", "json", {}));
  std::uint32_t sequence = 0;
  for (const auto& [time, said] : values) Must(writer->AddMessage({channel, ++sequence, time, 0, said}));
  Must(writer->Finish());
}

// The player's own task goes on, and says where what cannot be read was to be played.
TEST_F(RecordingPlayerTest, AnInputThatIsPlayedMayBeDeletedMeanwhile) {
  WriteInputs(Path("input.mcap"),
              {{0, R"({"value":7})"}, {60'000'000, R"({"value":14})"}, {70'000'000, R"({"value":"oops"})"}});
  Application other;
  const auto player = Must(Play(other, Path("input.mcap")));
  player->Start(Time{});
  other.Run(milliseconds(50));
  EXPECT_EQ(player->published(), 1u);
  Must(other.runtime.Delete(*other.sink));
  other.Run(milliseconds(50));
  EXPECT_EQ(player->published(), 2u);
  ASSERT_TRUE(player->failure());
  EXPECT_THAT(player->failure()->ToString(), HasSubstr("/sink/input/number: the value recorded at 0.07"));
  EXPECT_EQ(Saved(other), "");
}

TEST_F(RecordingPlayerTest, PlaysAStretchFromLaterOn) {
  Application recorded;
  const std::string file = Record("a.mcap", recorded, seconds(2), {"/source/*"});
  Application other;
  auto player = Must(Play(other, file, {.from = milliseconds(1000), .to = milliseconds(1500)}));
  EXPECT_EQ(player->start(), Time(milliseconds(1000)));
  EXPECT_EQ(player->length(), milliseconds(500));
  other.scheduler.simulated_clock().Set(player->start());
  player->Start(player->start());
  const std::string again = Record("b.mcap", other, seconds(1), {"/source/number"});
  const auto whole = ValuesOf(file, "/source/output/number");
  // What was the newest at the beginning comes first.
  EXPECT_EQ(ValuesOf(again, "/source/output/number"),
            std::vector<std::string>(whole.begin() + 99, whole.begin() + 151));
}

TEST_F(RecordingPlayerTest, PlaysIntoAnInputAsIfItsSourcesWereDisconnected) {
  WriteInputs(Path("input.mcap"), {{0, R"({"value":7})"}, {50'000'000, R"({"value":14})"}});
  Application other;
  auto player = Must(Play(other, Path("input.mcap")));
  player->Start(Time{});
  const std::string file = Record("b.mcap", other, milliseconds(100), {"**/sum"});
  const auto sums = ValuesOf(file, "/sink/output/sum");
  ASSERT_EQ(sums.size(), 10u);
  EXPECT_THAT(sums[0],
              testing::MatchesRegex("0 .\"value\":1\\.00.*"));  // 7 / 7 and the size of a sample
  EXPECT_THAT(sums[9], testing::MatchesRegex("90000000 .\"value\":3\\.0.*"));
}

TEST_F(RecordingPlayerTest, SaysWhatCannotBePlayed) {
  Application recorded;
  const std::string file = Record("a.mcap", recorded, milliseconds(100));
  const auto refusal = [&](const std::string& port) {
    Application other;
    const auto player = Play(other, file, {.ports = {port}});
    return player ? std::string("plays") : player.error().ToString();
  };
  EXPECT_THAT(refusal("/source/numbr"),
              HasSubstr("the recording has no port '/source/numbr'; did you mean '/source/number'?"));
  EXPECT_THAT(refusal("/nothing/**"), HasSubstr("the recording has no port that fits '/nothing/**'"));
  EXPECT_THAT(refusal("/sourc/*"), HasSubstr("there is '/source/number'"));
  Runtime empty;
  const auto player = Player::Prepare(empty, Must(McapReader::Open(file)), {});
  ASSERT_FALSE(player);
  EXPECT_THAT(player.error().ToString(), HasSubstr("the application has none of the ports that were recorded"));
  Application other;
  EXPECT_THAT(Play(other, file, {.from = seconds(5)}).error().message,
              HasSubstr("the recording ends before that: it has 0.09"));
}

TEST_F(RecordingPlayerTest, RefusesATypeThatHasChanged) {
  Application recorded;
  const std::string file = Record("a.mcap", recorded, milliseconds(100), {"**/sample"});
  Application other;
  auto writer = Must(McapWriter::Create(Path("changed.mcap"), {}));
  const auto schema = Must(writer->AddSchema("test::Sample", "jsonschema", "{}"));
  const auto channel = Must(writer->AddChannel(schema, "/source/output/sample", "json", {}));
  Must(writer->AddMessage({channel, 1, 1, 1, "{}"}));
  Must(writer->Finish());
  EXPECT_THAT(Play(other, Path("changed.mcap")).error().ToString(),
              HasSubstr("the type test::Sample was another one when it was recorded"));
}

TEST_F(RecordingPlayerTest, AValueThatCannotBeReadEndsThePlayingWithItsPlace) {
  Application other;
  auto writer = Must(McapWriter::Create(Path("bad.mcap"), {}));
  const auto schema = Must(writer->AddSchema("double", "jsonschema", kNumberSchema));
  const auto channel = Must(writer->AddChannel(schema, "/source/output/number", "json", {}));
  Must(writer->AddMessage({channel, 1, 0, 0, R"({"value":1.5})"}));
  Must(writer->AddMessage({channel, 2, 20'000'000, 0, R"({"value":"oops"})"}));
  Must(writer->Finish());
  auto player = Must(Play(other, Path("bad.mcap")));
  player->Start(Time{});
  other.Run(milliseconds(100));
  ASSERT_TRUE(player->failure());
  EXPECT_THAT(player->failure()->ToString(), HasSubstr("/source/output/number: the value recorded at 0.02"));
  EXPECT_EQ(player->published(), 1u);
}

}  // namespace
}  // namespace runnel::test

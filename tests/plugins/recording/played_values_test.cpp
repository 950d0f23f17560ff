#include "plugins/recording/played_values.h"

#include "tests/plugins/mcap/mcap_fixture.h"

namespace runnel::test {
namespace {

using testing::ElementsAre;

// The file has values at 0, 1000, … ns; every fifth is of channel 1.
class PlayedValuesTest : public McapTest {
 protected:
  std::unique_ptr<PlayedValues> Play(int messages, std::optional<Duration> from = {}, std::optional<Duration> to = {},
                                     bool loops = false) {
    auto values =
        std::make_unique<PlayedValues>(Must(McapReader::Open(WriteFile("a.mcap", "", messages))), from, to, loops);
    values->Want(0);
    values->Want(1);
    return values;
  }
  static std::vector<std::string> TakeAll(PlayedValues& values, std::uint16_t channel, std::int64_t now) {
    std::vector<std::string> all;
    while (auto value = values.Take(channel, Time(Duration(now)))) {
      all.push_back(std::to_string(value->time.time_since_epoch().count()) + value->json);
    }
    return all;
  }
};

TEST_F(PlayedValuesTest, GivesWhatIsDueAndNoMore) {
  const auto values = Play(60);
  values->Start(Time(Duration(0)));
  EXPECT_THAT(TakeAll(*values, 0, 1999), ElementsAre("0{\"x\":0}", "1000{\"x\":1}"));
  EXPECT_THAT(TakeAll(*values, 0, 1999), ElementsAre());
  EXPECT_THAT(TakeAll(*values, 0, 2000), ElementsAre("2000{\"x\":2}"));
  EXPECT_THAT(TakeAll(*values, 1, 9000), ElementsAre("4000{\"x\":4}", "9000{\"x\":9}"));
  EXPECT_EQ(TakeAll(*values, 0, 59'000).size(), 45u);
  EXPECT_FALSE(values->is_over());
  EXPECT_EQ(TakeAll(*values, 1, 59'000).size(), 10u);
  EXPECT_TRUE(values->is_over());
}

TEST_F(PlayedValuesTest, AreMovedOntoTheClockOfWhoPlays) {
  const auto values = Play(10);
  values->Start(Time(Duration(500'000)));
  EXPECT_THAT(TakeAll(*values, 0, 499'999), ElementsAre());
  EXPECT_THAT(TakeAll(*values, 0, 501'500), ElementsAre("500000{\"x\":0}", "501000{\"x\":1}"));
}

TEST_F(PlayedValuesTest, FromLaterOnBeginsWithWhatWasNewestThen) {
  const auto values = Play(60, Duration(42'500), Duration(47'000));
  EXPECT_EQ(values->start(), Time(Duration(42'500)));
  values->Start(values->start());
  EXPECT_THAT(TakeAll(*values, 0, 42'500), ElementsAre("42000{\"x\":42}"));
  EXPECT_THAT(TakeAll(*values, 1, 42'500), ElementsAre("39000{\"x\":39}"));
  EXPECT_THAT(TakeAll(*values, 0, 99'000),
              ElementsAre("43000{\"x\":43}", "45000{\"x\":45}", "46000{\"x\":46}", "47000{\"x\":47}"));
  EXPECT_THAT(TakeAll(*values, 1, 99'000), ElementsAre("44000{\"x\":44}"));
  EXPECT_TRUE(values->is_over());
}

TEST_F(PlayedValuesTest, BeginsAnewIfItLoopsAndTimeNeverGoesBack) {
  const auto values = Play(3, {}, {}, true);
  values->Start(Time(Duration(0)));
  std::int64_t last = -1;
  int count = 0;
  for (std::int64_t now = 0; now < 20'000; now += 100) {
    while (auto value = values->Take(0, Time(Duration(now)))) {
      EXPECT_GT(value->time.time_since_epoch().count(), last);
      EXPECT_LE(value->time.time_since_epoch().count(), now);
      last = value->time.time_since_epoch().count();
      ++count;
    }
  }
  EXPECT_GE(count, 28);
  EXPECT_FALSE(values->is_over());
}

TEST_F(PlayedValuesTest, TheTimesOfTheirMeasurementMoveWithThem) {
  auto writer = Must(McapWriter::Create(Path("a.mcap"), {}));
  const auto channel = Must(writer->AddChannel(0, "/x", "json", {}));
  Must(writer->AddMessage({channel, 0, 1000, 400, "1"}));
  Must(writer->AddMessage({channel, 1, 2000, 2000, "2"}));
  Must(writer->Finish());
  const auto measured = [&](bool loops, std::optional<Duration> from, std::int64_t start) {
    PlayedValues values(Must(McapReader::Open(Path("a.mcap"))), from, {}, loops);
    values.Want(channel);
    values.Start(Time(Duration(start)));
    std::vector<std::int64_t> times;
    while (times.size() < 2) {
      const auto value = values.Take(channel, Time(Duration(start + 1000)));
      if (!value) break;
      times.push_back(value->timestamp.time_since_epoch().count());
    }
    return times;
  };
  EXPECT_THAT(measured(false, {}, 1000), ElementsAre(400, 2000));
  EXPECT_THAT(measured(false, {}, 51'000), ElementsAre(50'400, 52'000));
  EXPECT_THAT(measured(true, Duration(500), 1500), ElementsAre(900, 2000))
      << "what is published later than it was is measured later, too";
}

// A port publishes several values in one cycle, and its chunks overlap where the recorder was held up.
TEST_F(PlayedValuesTest, OfOneTimeAreGivenAsTheyWereWritten) {
  auto writer = Must(McapWriter::Create(Path("a.mcap"), {}));
  const auto channel = Must(writer->AddChannel(0, "/x", "json", {}));
  const auto other = Must(writer->AddChannel(0, "/y", "json", {}));
  Must(writer->AddMessage({channel, 1, 20, 20, "1"}));
  Must(writer->AddMessage({channel, 2, 30, 30, "2"}));
  Must(writer->Flush());
  Must(writer->AddMessage({other, 1, 10, 10, "1"}));
  Must(writer->AddMessage({channel, 3, 30, 30, "3"}));
  Must(writer->AddMessage({channel, 4, 40, 40, "4"}));
  Must(writer->Finish());
  const auto played = [&](std::optional<Duration> from) {
    PlayedValues values(Must(McapReader::Open(Path("a.mcap"))), from, {}, false);
    values.Want(channel);
    values.Start(values.start());
    return TakeAll(values, channel, 100);
  };
  EXPECT_THAT(played({}), ElementsAre("201", "302", "303", "404"));
  EXPECT_THAT(played(Duration(25)), ElementsAre("303", "404")) << "begins with what was published last";
}

TEST_F(PlayedValuesTest, ARoundDoesNotWaitForWhoIsPaused) {
  auto writer = Must(McapWriter::Create(Path("a.mcap"), {}));
  const auto taken = Must(writer->AddChannel(0, "/x", "json", {}));
  const auto paused = Must(writer->AddChannel(0, "/y", "json", {}));
  for (const std::uint16_t channel : {taken, paused}) {
    Must(writer->AddMessage({channel, 0, 0, 0, "1"}));
    Must(writer->AddMessage({channel, 1, 1'000'000'000, 1'000'000'000, "2"}));
  }
  Must(writer->Finish());
  PlayedValues values(Must(McapReader::Open(Path("a.mcap"))), {}, {}, true);
  for (const std::uint16_t channel : {taken, paused}) values.Want(channel);
  values.Start(Time{});
  std::vector<double> times;
  for (double now = 0; now < 7; now += 0.01) {
    while (const auto value = values.Take(taken, Time(FromSeconds(now)))) times.push_back(ToSeconds(value->time));
  }
  using ::testing::DoubleNear;
  EXPECT_THAT(times, ElementsAre(DoubleNear(0, 0.02), DoubleNear(1, 0.02), DoubleNear(2, 0.02), DoubleNear(3, 0.03),
                                 DoubleNear(4, 0.03), DoubleNear(5, 0.04), DoubleNear(6, 0.05)));
}

TEST_F(PlayedValuesTest, ABrokenChunkEndsThePlaying) {
  const std::string file = WriteFile("a.mcap", "", 60);
  std::string bytes = ReadBytes(file);
  bytes[bytes.find("{\"x\":40}") + 1] = 'y';
  WriteBytes(file, bytes);
  PlayedValues values(Must(McapReader::Open(file)), {}, {}, false);
  values.Want(0);
  values.Start(Time{});
  EXPECT_GT(TakeAll(values, 0, 30'000).size(), 10u);
  EXPECT_FALSE(values.failure());
  (void)TakeAll(values, 0, 60'000);
  ASSERT_TRUE(values.failure());
  EXPECT_THAT(values.failure()->message, testing::HasSubstr("checksum"));
  EXPECT_TRUE(values.is_over());
}

}  // namespace
}  // namespace runnel::test

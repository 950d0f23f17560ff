#include "plugins/command_service/application_log.h"

#include <gmock/gmock.h>

namespace runnel::test {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(ApplicationLog, TellsWhenWhatHappened) {
  ManualClock clock;
  clock.Advance(std::chrono::seconds(7));
  ApplicationLog log(clock);
  clock.Advance(std::chrono::milliseconds(1500));
  log.Add(ApplicationLog::Kind::kFault, "boom\n", "/app/a", "boom");
  const auto read = log.ReadEntries(0, 10);
  ASSERT_THAT(read.entries, SizeIs(1));
  EXPECT_THAT(ApplicationLog::LineOf(read.entries[0]), EndsWith("      1.500 s  fault    boom"));
  EXPECT_EQ(read.entries[0].module, "/app/a");
  EXPECT_EQ(read.entries[0].cause, "boom");
  EXPECT_EQ(log.faults(), 1U);
  EXPECT_EQ(read.next, 1U);
  EXPECT_THAT(log.ReadEntries(read.next, 10).entries, IsEmpty());
}

TEST(ApplicationLog, KeepsTheNewestAndCountsWhatIsGone) {
  ManualClock clock;
  ApplicationLog log(clock);
  for (std::size_t i = 0; i < ApplicationLog::kMostEntries + 5; ++i) {
    log.Add(ApplicationLog::Kind::kChange, "entry " + std::to_string(i));
  }
  const auto read = log.ReadEntries(2, 3);
  EXPECT_EQ(read.lost, 3U);
  EXPECT_EQ(read.next, 8U);
  ASSERT_THAT(read.entries, SizeIs(3));
  EXPECT_THAT(ApplicationLog::LineOf(read.entries[0]), EndsWith("entry 5"));
}

TEST(ApplicationLog, CutsLongTextsAndIndentsFurtherLines) {
  ManualClock clock;
  ApplicationLog log(clock);
  log.Add(ApplicationLog::Kind::kWarning, std::string(100'000, 'x'));
  log.Add(ApplicationLog::Kind::kWarning, "a\nb");
  const auto read = log.ReadEntries(0, 2);
  EXPECT_LT(read.entries[0].text.size(), ApplicationLog::kLongestText + 100);
  EXPECT_THAT(ApplicationLog::LineOf(read.entries[1]), HasSubstr("a\n    b"));
}

}  // namespace runnel::test

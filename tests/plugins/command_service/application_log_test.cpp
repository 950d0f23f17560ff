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
  log.Add(ApplicationLog::Kind::kFault, "boom\n");
  const auto read = log.Read(0, 10);
  ASSERT_THAT(read.lines, SizeIs(1));
  EXPECT_THAT(read.lines[0], EndsWith("      1.500 s  fault    boom"));
  EXPECT_EQ(read.next, 1U);
  EXPECT_THAT(log.Read(read.next, 10).lines, IsEmpty());
}

TEST(ApplicationLog, KeepsTheNewestAndCountsWhatIsGone) {
  ManualClock clock;
  ApplicationLog log(clock);
  for (std::size_t i = 0; i < ApplicationLog::kMostEntries + 5; ++i) {
    log.Add(ApplicationLog::Kind::kChange, "entry " + std::to_string(i));
  }
  const auto read = log.Read(2, 3);
  EXPECT_EQ(read.lost, 3U);
  EXPECT_EQ(read.next, 8U);
  ASSERT_THAT(read.lines, SizeIs(3));
  EXPECT_THAT(read.lines[0], EndsWith("entry 5"));
}

TEST(ApplicationLog, CutsLongTextsAndIndentsFurtherLines) {
  ManualClock clock;
  ApplicationLog log(clock);
  log.Add(ApplicationLog::Kind::kWarning, std::string(100'000, 'x'));
  log.Add(ApplicationLog::Kind::kWarning, "a\nb");
  const auto read = log.Read(0, 2);
  EXPECT_LT(read.lines[0].size(), ApplicationLog::kLongestText + 100);
  EXPECT_THAT(read.lines[1], HasSubstr("a\n    b"));
}

}  // namespace runnel::test

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/apps/arena/arena_run.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class FailingRuns : public ArenaTest {};

TEST_F(FailingRuns, AreRowsAmongTheOthers) {
  const Ended ended = Arena(
      "--world open --plugin broken_bug --variant broken/crash,broken/hang,broken/throw,bug2 "
      "--wall-limit 4 --quiet --json " +
      File("runs.json"));
  EXPECT_EQ(ended.code, 0) << ended.text;
  EXPECT_THAT(ended.text, HasSubstr("2 of the runs crashed or hung"));
  EXPECT_THAT(ended.text, HasSubstr("WRONG: crashed: Aborted"));
  EXPECT_THAT(ended.text, HasSubstr("WRONG: hung: ended after 4 s of real time"));
  EXPECT_THAT(ended.text, HasSubstr("out of order"));
  const auto runs = Json("runs.json");
  ASSERT_EQ(runs.size(), 4u);
  EXPECT_EQ(runs[0]["outcome"], "error");
  EXPECT_EQ(runs[1]["outcome"], "timeout");
  EXPECT_GE(runs[1]["wall_time_s"].get<double>(), 4.0);
  EXPECT_EQ(runs[2]["outcome"], "error");
  EXPECT_EQ(runs[3]["outcome"], "reached");
}

TEST_F(FailingRuns, AreMadeAgainWhenTheArenaGoesOn) {
  const std::string words =
      "--world open --plugin broken_bug --variant broken/crash,bug2 "
      "--json " +
      File("runs.json");
  ASSERT_EQ(Arena(words).code, 0);
  const Ended ended = Arena(words + " --resume");
  EXPECT_THAT(ended.text, AllOf(HasSubstr("1 of 2 runs are finished already"), HasSubstr("[1/1] open broken/crash")));
}

TEST_F(FailingRuns, OfTooMuchSimulatedTimeAreTimeouts) {
  const Ended ended = Arena("--world spiral --variant bug1 --time-limit 20 --quiet --json " + File("runs.json"));
  EXPECT_EQ(ended.code, 0) << ended.text;
  const auto runs = Json("runs.json");
  EXPECT_EQ(runs[0]["outcome"], "timeout");
  EXPECT_NEAR(runs[0]["sim_time_s"].get<double>(), 20.0, 0.1);
  EXPECT_GT(runs[0]["path"].size(), 10u);
}

TEST_F(FailingRuns, OfAVariantWithoutATypeAreRefusedWithItsPlace) {
  Write("mine.xml", "<module>\n</module>\n");
  const Ended ended = Arena("--world open --variant " + File("mine.xml"));
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.text, HasSubstr("mine.xml:1:1: error: a variant is a <module> tag"));
}

}  // namespace
}  // namespace runnel::test

#include "apps/arena/journal.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "apps/arena/names.h"
#include "modules/simulation/referee.h"
#include "tests/support/temporary_folder.h"

namespace runnel::arena {
namespace {

using testing::HasSubstr;

RunRecord SomeRecord(const std::string& variant = "bug1") {
  return {
      .key = {"spiral", variant, "laser", "left", 3},
      .result = {.outcome = "reached",
                 .remark = "",
                 .path_length = 12.5,
                 .simulated_time = 40.05,
                 .cycles = 801,
                 .robot_radius = 0.15,
                 .hits = {{1, 2}, {3, 4}},
                 .leaves = {{5, 6}},
                 .path = {{{0, 0}, PathMode::kDrivingToGoal, 0.5, 0}, {{1, 0}, PathMode::kGoingToLeavePoint, -0.5, 2}}},
      .wall_time = 0.25,
      .processor_time = 0.125,
      .noise = 0.02,
      .shortest_path = 10.0};
}

PlannedRun PlannedFor(const RunRecord& record, const std::string& made_of = "abc") {
  return {.key = record.key, .course = 0, .application = "", .made_of = made_of};
}

class JournalTest : public testing::Test {
 protected:
  void Fill(const std::vector<RunRecord>& records) {
    auto journal = Journal::Begin(file_, {});
    ASSERT_TRUE(journal);
    for (const RunRecord& record : records) ASSERT_TRUE(journal->Add(record, "abc"));
  }
  std::string Text() { return *ReadFile(file_); }

  const test::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "journal";
};

TEST_F(JournalTest, KeepsAllOfARun) {
  Fill({SomeRecord()});
  const auto journal = Journal::Resume(file_, {});
  ASSERT_TRUE(journal);
  const RunRecord* const found = journal->Find(PlannedFor(SomeRecord()));
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(JournalLineOf(*found, ""), JournalLineOf(SomeRecord(), ""));
  EXPECT_EQ(found->result.path[1].mode, PathMode::kGoingToLeavePoint);
  EXPECT_EQ(journal->Find(PlannedFor(SomeRecord("bug2"))), nullptr);
}

TEST_F(JournalTest, ForgetsRunsOfAChangedWorldAndThoseThatCrashed) {
  RunRecord crashed = SomeRecord("bug2");
  crashed.has_ended_by_itself = false;
  Fill({SomeRecord(), crashed});
  const auto journal = Journal::Resume(file_, {});
  ASSERT_TRUE(journal);
  EXPECT_EQ(journal->Find(PlannedFor(SomeRecord(), "abd")), nullptr);
  EXPECT_EQ(journal->Find(PlannedFor(crashed)), nullptr);
}

TEST_F(JournalTest, DropsALineThatWasCutShortAndGoesOnBehindTheOthers) {
  Fill({SomeRecord()});
  const std::string whole = Text();
  std::ofstream(file_, std::ios::app) << "{\"world\":\"spi";
  auto journal = Journal::Resume(file_, {});
  ASSERT_TRUE(journal);
  EXPECT_EQ(Text(), whole);
  ASSERT_TRUE(journal->Add(SomeRecord("bug2"), "abc"));
  const auto again = Journal::Resume(file_, {});
  ASSERT_TRUE(again);
  EXPECT_NE(again->Find(PlannedFor(SomeRecord("bug2"))), nullptr);
}

TEST_F(JournalTest, RefusesABrokenLineWithItsPlace) {
  Fill({SomeRecord()});
  std::ofstream(file_, std::ios::app) << "{}\n";
  const auto journal = Journal::Resume(file_, {});
  ASSERT_FALSE(journal);
  EXPECT_EQ(journal.error().position.line, 3);
}

TEST_F(JournalTest, RefusesOtherSettingsAndOtherFiles) {
  Fill({});
  const auto journal = Journal::Resume(file_, {.safe_distance = 0.5});
  ASSERT_FALSE(journal);
  EXPECT_THAT(journal.error().message, HasSubstr("--safe-distance 0.35, not 0.5"));
  for (const char* head : {"[]", R"({"runnel_arena_journal": "1"})", R"({"runnel_arena_journal": 1, "noise": "0"})"}) {
    std::ofstream(file_) << head << "\n";
    EXPECT_FALSE(Journal::Resume(file_, {})) << head;
  }
}

TEST_F(JournalTest, BeginsWhereThereIsNone) {
  ASSERT_TRUE(Journal::Resume(file_, {}));
  EXPECT_THAT(Text(), HasSubstr("runnel_arena_journal"));
}

TEST_F(JournalTest, MergesTheLastLineOfEachRun) {
  Fill({SomeRecord()});
  {
    auto journal = Journal::Resume(file_, {});  // after its world was edited
    ASSERT_TRUE(journal && journal->Add(SomeRecord(), "abd"));
  }
  std::filesystem::copy_file(file_, folder_ / "old.json.journal");
  auto other = Journal::Begin(folder_ / "new.json.journal", {});
  ASSERT_TRUE(other && other->Add(SomeRecord(), "abd"));
  const auto merged = Merge(folder_ / "all.json", {folder_ / "new.json", folder_ / "old.json"});
  ASSERT_TRUE(merged) << merged.error().ToString();
  EXPECT_EQ(*merged, 1u);
  const auto all = Journal::Resume(folder_ / "all.json.journal", {});
  ASSERT_TRUE(all);
  EXPECT_NE(all->Find(PlannedFor(SomeRecord(), "abd")), nullptr);
}

TEST_F(JournalTest, DoesNotMergeIntoRunsWithoutAJournal) {
  ASSERT_TRUE(WriteFile(folder_ / "all.json", "[]"));
  auto part = Journal::Begin(folder_ / "part.json.journal", {});
  ASSERT_TRUE(part && part->Add(SomeRecord(), "abc"));
  const auto merged = Merge(folder_ / "all.json", {folder_ / "part.json"});
  ASSERT_FALSE(merged);
  EXPECT_THAT(merged.error().message, HasSubstr("there is no journal of these runs"));
  EXPECT_EQ(*ReadFile(folder_ / "all.json"), "[]");
}

TEST(RunRecordJson, SurvivesWhatIsNotUtf8) {
  RunRecord record = SomeRecord();
  record.result.remark = "\xff\"";
  EXPECT_TRUE(nlohmann::json::accept(JournalLineOf(record, "x")));
  EXPECT_TRUE(nlohmann::json::accept(JsonOf(std::vector{record, record})));
  EXPECT_TRUE(nlohmann::json::accept(JsonOf(std::vector<RunRecord>{})));
}

TEST(RunRecordJson, SaysWhetherARunIsRightAndWhyItHasFailed) {
  RunRecord record = SomeRecord();
  const auto right = nlohmann::json::parse(JsonOf(record));
  EXPECT_EQ(right.at("is_right"), true);
  EXPECT_EQ(right.at("ratio"), 1.25);
  EXPECT_EQ(right.at("noise_m"), 0.02);
  record.shortest_path.reset();
  record.result.remark = "no idea";
  const auto wrong = nlohmann::json::parse(JsonOf(record));
  EXPECT_EQ(wrong.at("is_right"), false);
  EXPECT_TRUE(wrong.at("ratio").is_null() && wrong.at("shortest_path_m").is_null());
  EXPECT_EQ(wrong.at("remark"), "no idea");
}

TEST(RunRecordJson, ReadsWhatTheRefereeWrites) {
  RunResult written = SomeRecord().result;
  written.remark = "a \"quoted\"\n\\ remark";
  const auto read = ParseRunResult(runnel::JsonOf(written));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->remark, written.remark);
  EXPECT_EQ(read->hits, written.hits);
  EXPECT_EQ(read->path[1].heading, -0.5);
  EXPECT_EQ(read->cycles, 801u);
  EXPECT_FALSE(ParseRunResult("{"));
  EXPECT_FALSE(ParseRunResult("{}"));
}

}  // namespace
}  // namespace runnel::arena

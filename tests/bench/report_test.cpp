#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>

#include "bench/report/bars.h"
#include "bench/report/charts.h"
#include "bench/report/comparison.h"
#include "bench/report/json_report.h"
#include "bench/report/peers.h"
#include "bench/report/quietness.h"
#include "bench/report/row.h"
#include "bench/report/table.h"
#include "bench/report/text.h"
#include "tests/support/temporary_folder.h"

namespace runnel::bench {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

Measurement Time(const std::string& workload, Role role, const std::string& by, std::vector<double> samples) {
  return {"group", {workload}, {role, by}, TimeQuantity(), std::move(samples)};
}

Results Example() {
  Results results;
  results.Add(Time(kBaselineWorkload, Role::kBaseline, kFetchAdd, {2, 2, 9}));
  results.Add(Time("work", Role::kRunnel, "ports", {6, 5, 7}));
  results.Add(Time("work", Role::kRival, "slow", {20}));
  results.Add(Time("work", Role::kRival, "quick", {12, 12, 12}));
  results.Add(Time("work", Role::kFloor, "nothing", {1}));
  results.Add(Time("other work", Role::kRival, "quickest", {1}));
  return results;
}

TEST(Measurement, CountsTheMedianOrTheBest) {
  Measurement times = Time("work", Role::kRunnel, "ports", {4, 1, 3, 9});
  EXPECT_EQ(times.Typical(), 3.5);
  times.best_counts = true;
  EXPECT_EQ(times.Typical(), 1);
  times.quantity.more_is_better = true;
  EXPECT_EQ(times.Typical(), 9);
  times.samples.clear();
  EXPECT_EQ(times.Typical(), 0);
}

Measurement Probed(std::vector<double> samples, std::vector<double> probes) {
  Measurement measurement = Time("work", Role::kRunnel, "ports", std::move(samples));
  measurement.probes = std::move(probes);
  return measurement;
}

TEST(Quietness, LeavesOutWhatTheProbeSaysAndNothingElse) {
  Results results;
  results.Add(Probed({5, 1, 6, 7}, {100, 150, 109, 111}));
  EXPECT_THAT(KeepQuiet(results).ToString(), HasSubstr("50.0 % of 4 repetitions"));
  EXPECT_THAT(results.all()[0].samples, ElementsAre(5, 6));
  EXPECT_FALSE(results.all()[0].is_disturbed);
}

TEST(Quietness, TakesAllOfACaseThatHasTooFewAndSaysSo) {
  Results results;
  results.Add(Probed({5, 6}, {100, 101}));
  results.Add(Probed({9, 8, 1, 7}, {150, 150, 100, 150}));
  const Quietness quietness = KeepQuiet(results);
  EXPECT_THAT(results.all()[1].samples, SizeIs(4));
  EXPECT_THAT(quietness.ToString(), HasSubstr("1 of 2 cases"));
  EXPECT_THAT(MainTable(results), HasSubstr("| ~7.50 ns "));
}

TEST(Quietness, SaysNothingWhereNothingWasProbed) {
  Results results = Example();
  EXPECT_THAT(KeepQuiet(results).ToString(), IsEmpty());
  EXPECT_THAT(results.all()[1].samples, SizeIs(3));
}

TEST(Row, NamesTheBestRivalOfTheSameWork) {
  const Results results = Example();
  const auto rows = MakeRows(results);
  ASSERT_THAT(rows, SizeIs(1));
  EXPECT_EQ(rows[0].in_f, 3);
  ASSERT_NE(rows[0].best_rival, nullptr);
  EXPECT_EQ(rows[0].best_rival->subject.name, "quick");
  EXPECT_EQ(rows[0].ratio, 2);
  EXPECT_EQ(rows[0].winner, "Runnel");
}

TEST(Row, SaysSoWhenARivalIsAheadOrLevel) {
  Results results;
  results.Add(Time("work", Role::kRunnel, "ports", {10}));
  results.Add(Time("work", Role::kRival, "level", {9.9}));
  EXPECT_EQ(MakeRows(results)[0].winner, "even");
  results.Add(Time("work", Role::kRival, "ahead", {5}));
  EXPECT_EQ(MakeRows(results)[0].winner, "ahead");
  EXPECT_EQ(MakeRows(results)[0].ratio, 0.5);
}

TEST(Row, TakesMoreForBetterWhereItIs) {
  Results results;
  const Quantity speed{"throughput", "M/s", true};
  results.Add({"group", {"work"}, {Role::kRunnel, "ports"}, speed, {10}});
  results.Add({"group", {"work"}, {Role::kRival, "slow"}, speed, {5}});
  results.Add({"group", {"work"}, {Role::kRival, "slower"}, speed, {4}});
  const auto rows = MakeRows(results);
  EXPECT_EQ(rows[0].best_rival->subject.name, "slow");
  EXPECT_EQ(rows[0].winner, "Runnel");
  EXPECT_EQ(rows[0].in_f, 0);
}

TEST(Bar, IsAMultipleOfFetchAdd) {
  const Results results = Example();
  const Measurement& mine = *results.Find("work", "ports", "time");
  const Verdict met = Judge({"work", "ports", Bar::Kind::kAtMost, 3}, mine, results);
  EXPECT_TRUE(met.is_known);
  EXPECT_TRUE(met.is_met);
  EXPECT_EQ(met.bar, "<= 3 f");
  EXPECT_FALSE(Judge({"work", "ports", Bar::Kind::kAtMost, 2.9}, mine, results).is_met);
}

TEST(Bar, IsAMultipleOfAnotherFigure) {
  const Results results = Example();
  const Measurement& mine = *results.Find("work", "ports", "time");
  const Bar::Reference quick{"work", "quick", "quick"};
  EXPECT_TRUE(Judge({"work", "ports", Bar::Kind::kAtMost, 0.5, quick}, mine, results).is_met);
  EXPECT_FALSE(Judge({"work", "ports", Bar::Kind::kAtLeast, 0.7, quick}, mine, results).is_met);
  const Bar::Reference missing{"work", "nobody", "nobody"};
  EXPECT_FALSE(Judge({"work", "ports", Bar::Kind::kAtMost, 1, missing}, mine, results).is_known);
}

TEST(Text, RoundsToThreeDigits) {
  EXPECT_EQ(Rounded(0.01234), "0.0123");
  EXPECT_EQ(Rounded(4.5678), "4.57");
  EXPECT_EQ(Rounded(789.4), "789");
  EXPECT_EQ(WithUnit(1234567, "ns"), "1235 us");
  EXPECT_EQ(WithUnit(12.34, "M/s"), "12.3 M/s");
  EXPECT_EQ(ShortWithUnit(10'000, "ns"), "10 us");
}

TEST(Table, ShowsRowsAndFailures) {
  Results results = Example();
  EXPECT_THAT(MainTable(results), HasSubstr("quick 12.0 ns"));
  EXPECT_THAT(MainTable(results), HasSubstr("ahead in 1 of 1"));
  EXPECT_THAT(Failures(results), IsEmpty());
  Measurement failed = Time("more work", Role::kRunnel, "ports", {});
  failed.error = "messages were lost";
  results.Add(failed);
  EXPECT_THAT(Failures(results), HasSubstr("messages were lost"));
  EXPECT_THAT(MainTable(results), HasSubstr("failed"));
}

TEST(Peers, AreDividedByTheBaselineOfTheirOwnMachine) {
  Results results = Example();
  EXPECT_THAT(PeerTable(results), IsEmpty());
  results.Add(Time("publish a double, 1 input", Role::kRunnel, "Publish", {2}));
  EXPECT_THAT(PeerTable(results), HasSubstr("| 1.00 f"));  // in f
  EXPECT_THAT(PeerTable(results), HasSubstr("| 7.46 f"));  // 47 ns / 6.3 ns
}

TEST(EarlierRun, IsComparedWithWhatJsonWrote) {
  const test::TemporaryFolder folder;
  const std::string file = folder / "report";
  std::ofstream(file) << ToJson({{{"processor", "a \"quoted\" one"}}, {"busy"}}, Example());
  const EarlierRun earlier(file);
  EXPECT_THAT(earlier.CompareWith(Example()), HasSubstr("even"));
  Results now;
  now.Add(Time("work", Role::kRunnel, "ports", {2, 3, 2}));
  EXPECT_THAT(earlier.CompareWith(now), HasSubstr("better"));
  Results noisy;
  noisy.Add(Time("work", Role::kRunnel, "ports", {6.5, 9, 12}));
  EXPECT_THAT(earlier.CompareWith(noisy), HasSubstr("noise"));
  Results worse;
  worse.Add(Time("work", Role::kRunnel, "ports", {8, 9, 12}));
  EXPECT_THAT(earlier.CompareWith(worse), HasSubstr("WORSE"));
}

TEST(EarlierRun, RefusesOtherFiles) {
  const test::TemporaryFolder folder;
  const std::string file = folder / "report";
  std::ofstream(file) << "{\"a\": 1}";
  EXPECT_THROW(EarlierRun{file}, std::runtime_error);
  EXPECT_THROW(EarlierRun{file + "/missing"}, std::runtime_error);
}

TEST(Charts, AreDrawnForEachWorkloadAndFamily) {
  Results results = Example();
  for (const double readers : {1.0, 1000.0}) {
    Measurement each = Time("publish", Role::kRunnel, "ports", {readers});
    each.workload.family = "publishing";
    each.workload.position = readers;
    results.Add(each);
  }
  const test::TemporaryFolder folder;
  WriteCharts(folder.path(), results);
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    names.push_back(entry.path().filename());
    EXPECT_GT(entry.file_size(), 100u);
  }
  EXPECT_THAT(names, ::testing::UnorderedElementsAre("index.html", "work_time.svg", "other_work_time.svg",
                                                     "publishing_time.svg"));
}

}  // namespace
}  // namespace runnel::bench

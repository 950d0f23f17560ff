#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/arena/progress.h"
#include "apps/arena/report.h"

namespace runnel::arena {
namespace {

using testing::HasSubstr;

Matrix OneCourse() {
  Course course;
  course.name = "<open>";
  course.world.start = {0, 0, 0};
  course.world.goal = {10, 0};
  course.shortest = ShortestPath{.length = 10, .points = {{0, 0}, {10, 0}}};
  Matrix matrix;
  matrix.courses.push_back(std::move(course));
  return matrix;
}

RunRecord Record(const std::string& variant, const std::string& outcome, double length, double time = 50,
                 double wall = 0.5) {
  return {.key = {"<open>", variant, "laser", "left", 1},
          .result = {.outcome = outcome, .path_length = length, .simulated_time = time},
          .wall_time = wall};
}

TEST(Tables, CountRightVerdictsAndTheMeanRatioOfThose) {
  const Matrix matrix = OneCourse();
  const std::vector<RunRecord> records{Record("bug1", "reached", 12), Record("bug1", "reached", 14),
                                       Record("bug1", "unreachable", 99), Record("bug2", "collision", 3)};
  const auto rows = RowsOf(matrix, records);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_TRUE(rows[0].is_right);
  EXPECT_NEAR(*rows[0].ratio, 1.2, 1e-12);
  EXPECT_FALSE(rows[2].is_right);
  EXPECT_EQ(rows[2].ratio, std::nullopt);
  EXPECT_TRUE(rows[0].is_over_bound) << "nothing was hit, so 10 m is the bound";
  const auto summaries = SummariesOf(rows);
  ASSERT_EQ(summaries.size(), 2u);
  EXPECT_EQ(summaries[0].runs, 3u);
  EXPECT_EQ(summaries[0].right, 2u);
  EXPECT_NEAR(*summaries[0].mean_ratio, 1.3, 1e-12);
  EXPECT_EQ(summaries[1].right, 0u);
  EXPECT_EQ(summaries[1].mean_ratio, std::nullopt);
  EXPECT_THAT(TablesText(rows, records), HasSubstr("66.7 %"));
}

TEST(Tables, TellTheSpeedOfThoseThatRanToTheirEnd) {
  RunRecord hung = Record("bug1", "timeout", 0, 0, 100);
  hung.has_ended_by_itself = false;
  RunRecord record = Record("bug1", "reached", 12);
  record.processor_time = 0.25;
  EXPECT_DOUBLE_EQ(SpeedOf({record, hung}).of_wall_time, 100.0);
  EXPECT_DOUBLE_EQ(SpeedOf({record, hung}).of_processor_time, 200.0);
  EXPECT_DOUBLE_EQ(SpeedOf({hung}).of_wall_time, 0.0);
}

TEST(Pages, DoNotTakeNamesForTags) {
  const std::string page = HtmlReport(OneCourse(), {Record("a<b>&\"", "reached", 12)}, RunSettings{});
  EXPECT_THAT(page, HasSubstr("a&lt;b&gt;&amp;&quot;"));
  EXPECT_THAT(page, HasSubstr("&lt;open&gt;"));
  EXPECT_THAT(page, testing::Not(HasSubstr("a<b>")));
}

TEST(ProgressLines, TellHowFarItIsAndWhatRemains) {
  EXPECT_EQ(ProgressLine(15, 60, 10.0), "[#######-----------------------]  25 %  15 of 60  0:30 left");
  EXPECT_EQ(ProgressLine(0, 60, 10.0), "[------------------------------]   0 %  0 of 60");
  EXPECT_EQ(ProgressLine(60, 60, 99.0), "[##############################] 100 %  60 of 60");
  EXPECT_THAT(ProgressLine(1, 601, 1.5), HasSubstr("15:00 left"));
}

}  // namespace
}  // namespace runnel::arena

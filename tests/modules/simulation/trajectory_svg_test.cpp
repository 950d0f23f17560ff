#include "modules/simulation/algorithm/trajectory_svg.h"

#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/types/algorithm/svg_writer.h"

namespace runnel {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

World ExampleWorld() {
  return {.name = "cup & <saucer>",
          .start = {-3, 0, 0},
          .goal = {3, 1},
          .polygons = {{.outline = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}},
                        .holes = {{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}}}},
          .boxes = {{.pose = {0, 3, 0}, .length = 1, .width = 1}},
          .cylinders = {{.centre = {0, -3}, .radius = 0.5}},
          .walls = {{.points = {{2, -2}, {3, -2}}, .thickness = 0.1}},
          .bounds = Ring{{-5, -5}, {5, -5}, {5, 5}, {-5, 5}}};
}

Trajectory ExampleTrajectory() {
  return {.path = {{{-3, 0}, PathMode::kDrivingToGoal},
                   {{-1.5, 0}, PathMode::kFollowingWall},
                   {{-1.5, 1.5}, PathMode::kFollowingWall},
                   {{1.5, 1.5}, PathMode::kGoingToLeavePoint},
                   {{1.5, 0.5}, PathMode::kDrivingToGoal},
                   {{3, 0.5}, PathMode::kDrivingToGoal}},
          .hits = {{-1.5, 0}},
          .leaves = {{1.5, 0.5}},
          .end = Pose2{3, 0.5, 0},
          .verdict = "goal reached",
          .tone = VerdictTone::kGood,
          .duration = 31.25,
          .length = 8.5};
}

int Count(const std::string& text, const std::string& part) {
  int count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// The first line of the text that has this part.
std::string LineWith(const std::string& part, const std::string& text) {
  const auto at = text.find(part);
  if (at == std::string::npos) return "";
  const auto begin = text.rfind('\n', at) + 1;
  return text.substr(begin, text.find('\n', at) - begin);
}

double NumberIn(const std::string& line, const std::string& attribute) {
  const std::string opening = " " + attribute + "=\"";
  const auto at = line.find(opening);
  return at == std::string::npos ? -1.0 : std::stod(line.substr(at + opening.size()));
}

TEST(TrajectorySvg, ShowsEveryObstacleTwiceForEdgeAndArea) {
  const std::string svg = TrajectorySvg(ExampleWorld(), {});
  for (const char* const kind : {"polygon", "box", "cylinder", "wall", "bounds"}) {
    EXPECT_EQ(Count(svg, "class=\"" + std::string(kind) + "\""), 2) << kind;
  }
}

TEST(TrajectorySvg, LeavesHolesFree) {
  const std::string polygon = LineWith("class=\"polygon\"", TrajectorySvg(ExampleWorld(), {}));
  // Two rings in one shape, filled by the even-odd rule.
  EXPECT_THAT(polygon, HasSubstr("fill-rule=\"evenodd\""));
  EXPECT_EQ(Count(polygon, "M"), 2);
  EXPECT_EQ(Count(polygon, "Z"), 2);
}

TEST(TrajectorySvg, TellsNameVerdictLengthAndTime) {
  const std::string svg = TrajectorySvg(ExampleWorld(), ExampleTrajectory());
  EXPECT_THAT(svg, AllOf(HasSubstr(">cup &amp; &lt;saucer&gt;<"), HasSubstr(">goal reached<"), HasSubstr("path 8.50 m"),
                         HasSubstr("straight line 6.08 m"), HasSubstr("time 31.2 s")));
}

TEST(TrajectorySvg, ColoursThePathByMode) {
  const std::string svg = TrajectorySvg(ExampleWorld(), ExampleTrajectory());
  const std::string path = svg.substr(svg.find("class=\"path\""));
  const std::string lines = path.substr(0, path.find("</g>"));
  EXPECT_EQ(Count(lines, "<polyline"), 4);
  EXPECT_EQ(Count(lines, "#2468d6"), 2);
  EXPECT_EQ(Count(lines, "#e07b1a"), 1);
  EXPECT_EQ(Count(lines, "#139c8f"), 1);
  EXPECT_EQ(Count(svg, "class=\"arrow\""), 5);
}

TEST(TrajectorySvg, MarksStartGoalHitsLeavesAndRobot) {
  const std::string svg = TrajectorySvg(ExampleWorld(), ExampleTrajectory());
  for (const char* const mark : {"start", "goal", "robot", "robot-heading"}) {
    EXPECT_EQ(Count(svg, "class=\"" + std::string(mark) + "\""), 1) << mark;
  }
  EXPECT_EQ(Count(svg, "class=\"hit\""), 2);  // one more in the legend
  EXPECT_EQ(Count(svg, "class=\"leave\""), 2);
  EXPECT_THAT(svg, AllOf(HasSubstr(">H1</text>"), HasSubstr(">L1</text>"), HasSubstr(">1 m<")));
}

// Where the next line of the grid is no other number.
TEST(TrajectorySvg, EndsFarFromTheOrigin) {
  EXPECT_LT(TrajectorySvg({.name = "far", .start = {1e16, 0, 0}, .goal = {1e16, 0}}, {}).size(), 100'000U);
}

TEST(TrajectorySvg, PutsYUp) {
  // The world is 10 m wide and high, and 0.7 m of air round it: 760 pixels for 11.4 m.
  const std::string svg = TrajectorySvg(ExampleWorld(), ExampleTrajectory());
  const std::string robot = LineWith("class=\"robot\"", svg);
  EXPECT_NEAR(NumberIn(robot, "cx"), 28 + 452 + 3 * 760 / 11.4, 0.01);
  EXPECT_NEAR(NumberIn(robot, "cy"), 74 + 380 - 0.5 * 760 / 11.4, 0.01);
}

TEST(TrajectorySvg, LegendNamesOnlyWhatIsThere) {
  Trajectory trajectory = ExampleTrajectory();
  EXPECT_EQ(Count(TrajectorySvg(ExampleWorld(), trajectory), "class=\"legend\""), 5);
  trajectory = {.path = {{{-3, 0}}, {{3, 0}}}};
  const std::string svg = TrajectorySvg(ExampleWorld(), trajectory);
  EXPECT_EQ(Count(svg, "class=\"legend\""), 1);
  EXPECT_THAT(svg, AllOf(HasSubstr("driving to the goal"), Not(HasSubstr("following a wall"))));
}

TEST(TrajectorySvg, IsACompleteFileAndTheSameEveryTime) {
  const std::string svg = TrajectorySvg(ExampleWorld(), ExampleTrajectory());
  EXPECT_THAT(svg, AllOf(StartsWith("<svg xmlns=\"http://www.w3.org/2000/svg\""), EndsWith("</svg>\n")));
  EXPECT_EQ(Count(svg, "<g "), Count(svg, "</g>"));
  EXPECT_EQ(svg, TrajectorySvg(ExampleWorld(), ExampleTrajectory()));
}

TEST(TrajectorySvg, LeavesOutWhatIsNotFinite) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  Trajectory trajectory = ExampleTrajectory();
  trajectory.path.push_back({{none, 0}});
  trajectory.hits.push_back({0, none});
  trajectory.leaves.push_back({none, none});
  trajectory.end = Pose2{none, none, none};
  const std::string svg = TrajectorySvg(ExampleWorld(), trajectory);
  EXPECT_THAT(svg, AllOf(Not(HasSubstr("nan")), Not(HasSubstr("inf")), HasSubstr("path 8.50 m")));
}

TEST(TrajectorySvg, DrawsLargeWorldsWithACoarserGrid) {
  const std::string svg = TrajectorySvg({.goal = {5000, 0}}, {});
  EXPECT_LT(Count(svg, "<line"), 150);
  EXPECT_THAT(svg, HasSubstr(">100 m<"));
}

TEST(SvgDecimal, HasAFixedNumberOfDigits) {
  EXPECT_EQ(Decimal(1.0), "1.00");
  EXPECT_EQ(Decimal(-1.255, 1), "-1.3");
  EXPECT_EQ(Decimal(-0.001), "0.00");
  EXPECT_EQ(Decimal(1e9, 0), "1000000000");
}

}  // namespace
}  // namespace runnel

// The three environments of the paper that the generic algorithm is from, with all variants, as its
// authors tell them: nobody reaches the goal of the first, everybody that of the second, and in the
// third Bug2 and Alg1 part where the robot meets a point again.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/apps/arena/arena_run.h"

namespace runnel::test {
namespace {

using nlohmann::json;

constexpr std::size_t kVariants = 11;  // ten of the Bug family, and a network of behaviours

class PaperWorlds : public ArenaTest {
 protected:
  json Runs(const std::string& words) const {
    const Ended ended = Arena("--quiet --sensor laser " + words + " --json " + File("runs.json"));
    EXPECT_EQ(ended.code, 0) << ended.text;
    return Json("runs.json");
  }
};

double DistanceBetween(const json& a, const json& b) {
  return std::hypot(a[0].get<double>() - b[0].get<double>(), a[1].get<double>() - b[1].get<double>());
}

json PlaceOf(const json& path_point) { return {path_point[1], path_point[2]}; }

TEST_F(PaperWorlds, NoVariantReachesTheGoalThatIsWalledIn) {
  const json runs = Runs("--world paper_1_unreachable --variant all --time-limit 200");
  ASSERT_EQ(runs.size(), kVariants);
  for (const json& run : runs) {
    // Com does not find out, and goes round for ever; so does a network of behaviours.
    const bool does_not_find_out = run["variant"] == "com" || run["variant"] == "behaviours/navigator";
    EXPECT_EQ(run["outcome"], does_not_find_out ? "timeout" : "unreachable") << run["variant"];
  }
}

TEST_F(PaperWorlds, EveryVariantReachesTheGoalBehindOneObstacle) {
  const json runs = Runs("--world paper_2_one_obstacle --variant all");
  ASSERT_EQ(runs.size(), kVariants);
  for (const json& run : runs) EXPECT_EQ(run["outcome"], "reached") << run["variant"];
}

TEST_F(PaperWorlds, Bug2AndAlg1PartWhereTheRobotMeetsAPointAgain) {
  const json runs = Runs("--world paper_3_points_met_again --variant bug2,alg1");
  ASSERT_EQ(runs.size(), 2u);
  const json &bug2 = runs[0], &alg1 = runs[1];
  ASSERT_EQ(alg1["variant"], "alg1");
  ASSERT_EQ(bug2["variant"], "bug2");
  EXPECT_EQ(alg1["outcome"], "reached");
  EXPECT_EQ(bug2["outcome"], "reached");

  const json &one = alg1["path"], &other = bug2["path"];
  std::size_t parting = 0;
  while (parting < std::min(one.size(), other.size()) && one[parting] == other[parting]) ++parting;
  ASSERT_LT(parting, std::min(one.size(), other.size())) << "both have taken the same way";
  const json place = PlaceOf(one[parting]);

  double nearest = std::numeric_limits<double>::infinity();
  for (const char* kind : {"hits", "leaves"}) {
    for (const json& point : alg1[kind]) nearest = std::min(nearest, DistanceBetween(point, place));
  }
  EXPECT_LT(nearest, 0.5) << "they part at " << place;
  // Met again: the robot has been there before, and somewhere else since.
  std::size_t before = 0;
  while (DistanceBetween(PlaceOf(one[before]), place) > 0.5) ++before;
  double away = 0.0;
  for (std::size_t i = before; i < parting; ++i) {
    away = std::max(away, DistanceBetween(PlaceOf(one[i]), place));
  }
  EXPECT_LT(before, parting);
  EXPECT_GT(away, 2.0);
}

}  // namespace
}  // namespace runnel::test

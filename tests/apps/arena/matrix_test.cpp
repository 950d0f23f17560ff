#include "apps/arena/matrix.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/arena/names.h"

namespace runnel::arena {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

const std::vector<std::string> kTypes{"other/planner", "planning/alg1", "planning/bug", "planning/bug1"};

std::vector<std::string> NamesOf(const std::vector<Variant>& variants) {
  std::vector<std::string> names;
  for (const Variant& variant : variants) names.push_back(variant.name);
  return names;
}

TEST(Variants, AllAreThosePublished) {
  Diagnostics diagnostics;
  EXPECT_THAT(NamesOf(FindVariants({"all"}, kTypes, diagnostics)), ElementsAre("alg1", "bug1"));
  EXPECT_THAT(NamesOf(FindVariants({"bug1", "all", "other/planner"}, kTypes, diagnostics)),
              ElementsAre("bug1", "alg1", "other/planner"));
  EXPECT_TRUE(diagnostics.ok());
}

TEST(Variants, ANetworkOfBehavioursIsBesideThem) {
  Diagnostics diagnostics;
  auto types = kTypes;
  types.push_back("behaviours/fusion");
  types.push_back("behaviours/navigator");
  EXPECT_THAT(NamesOf(FindVariants({"all"}, types, diagnostics)), ElementsAre("alg1", "bug1", "behaviours/navigator"));
  const Variant network{.name = "behaviours/navigator", .type = "behaviours/navigator"};
  const auto text = ApplicationText(FindProduct().applications / "laser.xml", network, {});
  ASSERT_TRUE(text);
  EXPECT_THAT(*text, HasSubstr("<load plugin=\"behaviours\"/>"));
  EXPECT_THAT(*text, HasSubstr("<module name=\"planner\" type=\"behaviours/navigator\">"));
}

TEST(Variants, ThatAreNotThereAreToldWithTheNearest) {
  Diagnostics diagnostics;
  EXPECT_TRUE(FindVariants({"bg1", "other/planer"}, kTypes, diagnostics).empty());
  EXPECT_THAT(diagnostics.ToString(), HasSubstr("'bug1'"));
  EXPECT_THAT(diagnostics.ToString(), HasSubstr("'other/planner'"));
}

TEST(ApplicationTexts, HaveThePlannerAndThePluginsAskedFor) {
  for (const std::string sensor : {"laser", "infrared", "bumper"}) {
    const auto file = std::filesystem::path(RUNNEL_XML) / "apps" / "arena" / (sensor + ".xml");
    const auto text =
        ApplicationText(file, {"mine", "other/planner", "<parameter name=\"x\" value=\"1\"/>"}, {"other"});
    ASSERT_TRUE(text) << text.error().ToString();
    EXPECT_THAT(*text, HasSubstr("<module name=\"planner\" type=\"other/planner\"><parameter "
                                 "name=\"x\" value=\"1\"/>"));
    EXPECT_THAT(*text, HasSubstr("<load plugin=\"other\"/>"));
    EXPECT_THAT(*text, Not(HasSubstr("type=\"planning/bug2\"")));
  }
}

TEST(ApplicationTexts, WithoutAPlaceForAPlannerAreRefused) {
  const auto file = std::filesystem::path(RUNNEL_XML) / "worlds" / "open.xml";
  const auto text = ApplicationText(file, {"bug1", "planning/bug1"}, {});
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().position.file, file.string());
}

TEST(Matrices, HaveEveryCombinationOnce) {
  Diagnostics diagnostics;
  const ArenaArguments arguments{.worlds = {"open", "cup", "open"},
                                 .variants = {"bug1", "bug2", "bug1"},
                                 .sensors = {"laser", "infrared"},
                                 .directions = {"left", "right", "left"},
                                 .seeds = {1, 2, 3}};
  const auto matrix = MakeMatrix(arguments, FindProduct(), diagnostics);
  ASSERT_TRUE(matrix) << diagnostics.ToString();
  EXPECT_EQ(matrix->runs.size(), 2u * 2u * 2u * 2u * 3u);
  std::vector<RunKey> keys;
  for (const PlannedRun& run : matrix->runs) keys.push_back(run.key);
  std::ranges::sort(keys);
  EXPECT_EQ(std::ranges::adjacent_find(keys), keys.end());
  EXPECT_NE(matrix->runs.front().made_of, matrix->runs.back().made_of);
}

TEST(Courses, KnowWhatIsRight) {
  Diagnostics diagnostics;
  const ArenaArguments arguments{
      .worlds = {"cup", "goal_in_obstacle", "goal_too_near_wall", "start_walled_in", "scatter_unreachable", "maze"}};
  const auto matrix = MakeMatrix(arguments, FindProduct(), diagnostics);
  ASSERT_TRUE(matrix) << diagnostics.ToString();
  std::vector<bool> can_be_reached;
  for (const Course& course : matrix->courses) {
    can_be_reached.push_back(course.IsRight("reached"));
    EXPECT_NE(course.IsRight("reached"), course.IsRight("unreachable"));
    EXPECT_FALSE(course.IsRight("timeout"));
  }
  EXPECT_THAT(can_be_reached, ElementsAre(true, false, false, false, false, true));
}

}  // namespace
}  // namespace runnel::arena

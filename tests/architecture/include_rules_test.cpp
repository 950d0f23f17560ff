// Planted offences, to show that the rules are able to fail.

#include "tests/architecture/include_rules.h"

#include <gmock/gmock.h>

namespace runnel::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A tree with one header in each of a few parts, all innocent.
SourceTree Innocent() {
  return {{"core/base/error.h", "#include <string>\n"},
          {"core/port/input.h", "#include \"core/base/error.h\"\n"},
          {"plugins/parameters/parameter.h", "#include \"core/port/input.h\"\n"},
          {"plugins/scheduling/thread.h", "#include \"core/base/error.h\"\n"},
          {"plugins/scheduling/internal/flow.h", ""},
          {"plugins/finroc_files/reader.h",
           "#include \"plugins/scheduling/thread.h\"\n"
           "#include \"plugins/application_files/tag.h\"\n"},
          {"plugins/application_files/tag.h", "#include \"plugins/parameters/parameter.h\"\n"},
          {"modules/types/algorithm/pose.h", "#include <cmath>\n#include <Eigen/Core>\n"},
          {"modules/types/pose_type.h", "#include \"modules/types/algorithm/pose.h\"\n"},
          {"modules/planning/algorithm/bug.h",
           "#include \"modules/types/algorithm/pose.h\"\n"
           "#include \"modules/planning/algorithm/wall.h\"\n"},
          {"modules/planning/algorithm/wall.h", ""},
          {"modules/planning/planner.h",
           "#include \"modules/planning/algorithm/bug.h\"\n"
           "#include \"plugins/parameters/parameter.h\"\n"
           "#include \"modules/types/pose_type.h\"\n"},
          {"modules/simulation/algorithm/world.cpp", "#include <btBulletDynamicsCommon.h>\n"},
          {"apps/runnel/main.cpp", "#include \"plugins/finroc_files/reader.h\"\n"},
          {"tests/modules/planning/bug_test.cpp",
           "#include \"modules/planning/algorithm/bug.h\"\n"
           "#include \"plugins/scheduling/internal/flow.h\"\n"}};
}

// The offences that come of adding `line` to `file`.
std::vector<std::string> Planted(const std::string& file, const std::string& line) {
  SourceTree tree = Innocent();
  tree[file] += line + "\n";
  return IncludeOffences(tree, ProjectRules());
}

TEST(IncludeRulesTest, InnocentTreePasses) {
  EXPECT_THAT(IncludeOffences(Innocent(), ProjectRules()), IsEmpty());
  EXPECT_THAT(Circles(Innocent(), ProjectRules()), IsEmpty());
}

TEST(IncludeRulesTest, CoreKnowsOnlyWhatIsBelow) {
  EXPECT_THAT(Planted("core/base/error.h", "#include \"core/port/input.h\""),
              ElementsAre("core/base/error.h:2: core/base may not know \"core/port/input.h\""));
}

TEST(IncludeRulesTest, CoreKnowsNoPluginNorModule) {
  EXPECT_EQ(Planted("core/port/input.h", "#include \"plugins/parameters/parameter.h\"").size(), 1u);
  EXPECT_EQ(Planted("core/port/input.h", "#include \"modules/types/pose_type.h\"").size(), 1u);
}

TEST(IncludeRulesTest, PluginsKnowOnlyTheirDeclaredNeighbours) {
  const std::string tag = "#include \"plugins/application_files/tag.h\"";
  EXPECT_EQ(Planted("plugins/scheduling/thread.h", tag).size(), 1u);
  EXPECT_EQ(Planted("plugins/parameters/parameter.h", tag).size(), 1u);
  EXPECT_THAT(Planted("plugins/finroc_files/reader.h", tag), IsEmpty());
  EXPECT_EQ(Planted("plugins/scheduling/thread.h", "#include \"plugins/finroc_files/reader.h\"").size(), 1u);
}

TEST(IncludeRulesTest, AlgorithmsKnowNoFramework) {
  const std::string file = "modules/planning/algorithm/bug.h";
  EXPECT_THAT(Planted(file, "#include \"core/base/error.h\""),
              ElementsAre(HasSubstr("modules/planning/algorithm may not know")));
  EXPECT_EQ(Planted(file, "#include \"modules/types/pose_type.h\"").size(), 1u);
  EXPECT_EQ(Planted(file, "#include \"modules/planning/planner.h\"").size(), 1u);
  EXPECT_EQ(Planted(file, "#include <sys/socket.h>").size(), 1u);
  EXPECT_EQ(Planted(file, "#include <gtest/gtest.h>").size(), 1u);
  EXPECT_EQ(Planted("modules/types/algorithm/pose.h", "#include \"core/base/error.h\"").size(), 1u);
}

TEST(IncludeRulesTest, OnlyTheSimulationKnowsThePhysicsEngine) {
  const std::string bullet = "#include <btBulletDynamicsCommon.h>";
  EXPECT_THAT(Planted("modules/planning/algorithm/bug.h", bullet),
              ElementsAre(HasSubstr("bug.h:3: Bullet is for modules/simulation only")));
  EXPECT_EQ(Planted("modules/planning/planner.h", "#include <bullet/btVector3.h>").size(), 1u);
  EXPECT_EQ(Planted("core/port/input.h", bullet).size(), 1u);
  EXPECT_THAT(Planted("modules/simulation/algorithm/world.cpp", bullet), IsEmpty());
}

TEST(IncludeRulesTest, OfThePluginsModulesKnowTheParametersOnly) {
  const std::string file = "modules/planning/planner.h";
  EXPECT_THAT(Planted(file, "#include \"plugins/scheduling/thread.h\""),
              ElementsAre(HasSubstr("modules/planning may not know \"plugins/scheduling/thread.h\"")));
  EXPECT_EQ(Planted(file, "#include \"plugins/application_files/tag.h\"").size(), 1u);
}

TEST(IncludeRulesTest, FamiliesOfModulesDoNotKnowEachOther) {
  EXPECT_EQ(Planted("modules/planning/planner.h", "#include \"modules/simulation/algorithm/world.cpp\"").size(), 1u);
  EXPECT_EQ(Planted("modules/simulation/algorithm/world.cpp", "#include \"modules/planning/algorithm/bug.h\"").size(),
            1u);
}

TEST(IncludeRulesTest, ProgramsKnowNoModules) {
  EXPECT_EQ(Planted("apps/runnel/main.cpp", "#include \"modules/types/pose_type.h\"").size(), 1u);
}

TEST(IncludeRulesTest, InternalFoldersBelongToTheirLibrary) {
  const std::string internal = "#include \"plugins/scheduling/internal/flow.h\"";
  EXPECT_THAT(Planted("apps/runnel/main.cpp", internal), ElementsAre(HasSubstr("is internal to plugins/scheduling")));
  EXPECT_THAT(Planted("plugins/scheduling/thread.h", internal), IsEmpty());
}

TEST(IncludeRulesTest, IncludesBeginAtTheRootOfTheTree) {
  EXPECT_THAT(Planted("core/port/input.h", "#include \"error.h\""),
              ElementsAre(HasSubstr("is no file, seen from the root")));
  EXPECT_EQ(Planted("core/port/input.h", "  #  include \"../base/error.h\"").size(), 1u);
}

TEST(IncludeRulesTest, GoogleTestIsForTestsOnly) {
  const std::string google_test = "#include \"gtest/gtest.h\"";
  EXPECT_THAT(Planted("tests/modules/planning/bug_test.cpp", google_test), IsEmpty());
  EXPECT_EQ(Planted("core/port/input.h", google_test).size(), 1u);
}

TEST(IncludeRulesTest, FolderThatNobodyHasThoughtOfIsAnOffence) {
  EXPECT_THAT(Planted("plugins/blackboard/board.h", ""),
              ElementsAre(HasSubstr("plugins/blackboard/board.h:1: falls under no rule")));
}

TEST(IncludeRulesTest, CirclesAreTold) {
  SourceTree tree = Innocent();
  tree["core/base/error.h"] += "#include \"core/port/input.h\"\n";
  EXPECT_THAT(Circles(tree, ProjectRules()), ElementsAre(HasSubstr("core/port > core/base")));
}

}  // namespace
}  // namespace runnel::test

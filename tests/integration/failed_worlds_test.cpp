// Worlds of `runnel world` in which a planner once touched a wall or told a wrong verdict with infrared rangers, in the
// arena's application.

#include <algorithm>
#include <stdexcept>

#include <gmock/gmock.h>

#include "core/base/error.h"
#include "modules/simulation/algorithm/world_geometry.h"
#include "modules/simulation/world_file/world_file.h"
#include "tests/integration/application_run.h"

namespace runnel::test {
namespace {

constexpr double kBodyRadius = 0.15;  // m

struct Attempt {
  const char* world;    // in tests/integration/worlds
  const char* planner;  // its type
  const char* direction;
  const char* verdict;
};

void PrintTo(const Attempt& attempt, std::ostream* stream) {
  *stream << attempt.planner << " in " << attempt.world << ", " << attempt.direction;
}

class OnceFailed : public testing::TestWithParam<Attempt> {};

TEST_P(OnceFailed, ComesToTheRightVerdictAndTouchesNothing) {
  const Attempt& attempt = GetParam();
  const std::string file = std::string(RUNNEL_XML "/../tests/integration/worlds/") + attempt.world + ".xml";
  Diagnostics diagnostics;
  const auto world = ReadWorldFile(file, diagnostics);
  ASSERT_TRUE(world) << diagnostics.ToString();
  const ApplicationRun run = RunApplication(
      {.name = "arena/infrared.xml",
       .replace = {{"planning/bug2", attempt.planner},
                   {R"(<load plugin="planning"/>)", R"(<load plugin="planning"/><load plugin="behaviours"/>)"}},
       .arguments = {"world=" + file, std::string("first_direction=") + attempt.direction}});
  ASSERT_TRUE(run.outcome);
  EXPECT_EQ(run.outcome->verdict, attempt.verdict) << run.outcome->summary;
  for (const Pose2& pose : run.truth) ASSERT_GT(ClearanceAt(*world, Position(pose)), kBodyRadius);
}

INSTANTIATE_TEST_SUITE_P(Attempts, OnceFailed,
                         testing::Values(Attempt{"comb_1005", "planning/tangent_bug", "left", "reached"},
                                         Attempt{"comb_1026", "behaviours/navigator", "right", "reached"},
                                         Attempt{"comb_1043", "planning/tangent_bug", "left", "reached"},
                                         Attempt{"maze_1001", "planning/tangent_bug", "left", "reached"},
                                         Attempt{"maze_1007", "behaviours/navigator", "left", "reached"},
                                         Attempt{"maze_1010", "planning/bug1", "right", "reached"},
                                         Attempt{"maze_1032", "planning/alg2", "right", "unreachable"},
                                         Attempt{"spiral_1014", "planning/rev2", "left", "reached"}),
                         [](const auto& attempt) {
                           std::string name = std::string(attempt.param.world) + "_" + attempt.param.planner + "_" +
                                              attempt.param.direction;
                           std::ranges::replace(name, '/', '_');
                           return name;
                         });

}  // namespace
}  // namespace runnel::test

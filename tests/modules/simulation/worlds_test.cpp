#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/simulation/algorithm/world.h"
#include "modules/simulation/algorithm/world_geometry.h"
#include "modules/simulation/world_file/world_file.h"

namespace runnel {
namespace {

std::vector<std::string> WorldNames() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(RUNNEL_WORLDS)) {
    if (entry.path().extension() == ".xml") names.push_back(entry.path().stem().string());
  }
  std::ranges::sort(names);
  return names;
}

class WorldOfTheTree : public testing::TestWithParam<std::string> {
 protected:
  World Load() {
    Diagnostics diagnostics;
    const auto path = std::filesystem::path(RUNNEL_WORLDS) / (GetParam() + ".xml");
    auto world = ReadWorldFile(path, diagnostics);
    if (!world) throw std::runtime_error(diagnostics.ToString());
    return *world;
  }
};

TEST_P(WorldOfTheTree, LoadsAndIsCalledAsItsFile) { EXPECT_EQ(Load().name, GetParam()); }

TEST_P(WorldOfTheTree, LeavesRoomForTheRobotAtTheStart) {
  const World world = Load();
  EXPECT_GT(ClearanceAt(world, Position(world.start)), RobotOptions{}.radius);
}

TEST_P(WorldOfTheTree, SurvivesWritingAndReading) {
  const World world = Load();
  Diagnostics diagnostics;
  EXPECT_EQ(ReadWorld(WriteWorld(world), "again.xml", diagnostics), world) << diagnostics.ToString();
}

TEST(WorldsOfTheTree, AreAllThere) {
  EXPECT_THAT(WorldNames(), testing::IsSupersetOf({"blocks",
                                                   "comb",
                                                   "corridor",
                                                   "cup",
                                                   "far_m_line",
                                                   "goal_in_obstacle",
                                                   "goal_too_near_wall",
                                                   "hook",
                                                   "maze",
                                                   "met_again",
                                                   "one_obstacle",
                                                   "open",
                                                   "paper_1_unreachable",
                                                   "paper_2_one_obstacle",
                                                   "paper_3_points_met_again",
                                                   "rooms",
                                                   "scatter",
                                                   "scatter_unreachable",
                                                   "spiral",
                                                   "start_walled_in",
                                                   "thin_wall",
                                                   "unreachable"}));
}

INSTANTIATE_TEST_SUITE_P(All, WorldOfTheTree, testing::ValuesIn(WorldNames()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace runnel

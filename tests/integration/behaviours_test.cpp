// A network of behaviours drives the robot, and takes turns with planners.

#include <cmath>
#include <cstring>
#include <optional>

#include <gmock/gmock.h>

#include "plugins/testing/guards.h"
#include "tests/integration/application_run.h"

namespace runnel::test {
namespace {

using namespace std::chrono_literals;
using ::testing::IsEmpty;

ApplicationChoice Demo(const std::string& world) {
  return {.name = "behaviour_demo.xml", .arguments = {"world=" RUNNEL_XML "/worlds/" + world + ".xml", "picture="}};
}
/// The Bug's application with a way to networks of behaviours.
ApplicationChoice BugDemo(const std::string& world) {
  ApplicationChoice choice = Demo(world);
  choice.name = "bug_demo.xml";
  choice.replace = {{"<load plugin=\"planning\"/>", "<load plugin=\"planning\"/><load plugin=\"behaviours\"/>"}};
  return choice;
}

bool AreSame(const std::vector<Pose2>& a, const std::vector<Pose2>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Pose2)) == 0;
}

class BehaviourWorlds : public ::testing::TestWithParam<const char*> {};

TEST_P(BehaviourWorlds, TheNetworkGetsToTheGoal) {
  const ApplicationRun run = RunApplication(Demo(GetParam()));
  ASSERT_TRUE(run.outcome);
  EXPECT_EQ(run.outcome->verdict, "reached") << run.outcome->summary;
  EXPECT_THAT(run.faults, IsEmpty());
}

// Round obstacles, through doors, out of dead ends.
INSTANTIATE_TEST_SUITE_P(Worlds, BehaviourWorlds,
                         ::testing::Values("open", "one_obstacle", "rooms", "cup", "thin_wall", "maze"),
                         [](const auto& world) { return std::string(world.param); });

TEST(BehaviourDemoTest, DrivesTheSameWayEachTime) {
  const ApplicationRun first = RunApplication(Demo("rooms"));
  const ApplicationRun second = RunApplication(Demo("rooms"));
  ASSERT_FALSE(first.truth.empty());
  EXPECT_TRUE(AreSame(first.truth, second.truth));
}

TEST(BehaviourDemoTest, TheNetworkThatIsOneModuleDrivesAsTheOneInTheFile) {
  const ApplicationRun in_file = RunApplication(Demo("rooms"));
  ApplicationChoice choice = BugDemo("rooms");
  choice.replace.emplace_back("planning/bug2", "behaviours/navigator");
  const ApplicationRun one_module = RunApplication(choice);
  ASSERT_TRUE(one_module.outcome);
  EXPECT_EQ(one_module.outcome->verdict, "reached");
  ASSERT_FALSE(in_file.truth.empty());
  EXPECT_TRUE(AreSame(in_file.truth, one_module.truth));
}

// Who rests where driving is content is not stuck, and is not driven away from there.
TEST(BehaviourDemoTest, StaysWhereItHasArrivedAlsoWithALargerTolerance) {
  ApplicationChoice choice = Demo("one_obstacle");
  choice.replace = {{"<parameter name=\"goal_tolerance\" to=", "<parameter name=\"goal_tolerance\" value=\"0.3\" to="},
                    {"<module name=\"referee\"", "<!-- <module name=\"referee\""},
                    {"<parameter name=\"time_limit\" command_line=\"time_limit\"/>\n  </module>", "-->"},
                    {"laser/scene referee/scene", "laser/scene"},
                    {"localisation/truth referee/pose", "localisation/truth"},
                    {"bumper/truth referee/contact", "bumper/truth"},
                    {"network/goal referee/goal", "network/goal"},
                    {"<connect from=\"network/status\" to=\"referee/status\"/>", ""}};
  choice.arguments.pop_back();  // the referee's picture
  choice.limit = 120s;
  const ApplicationRun run = RunApplication(choice);
  EXPECT_THAT(run.faults, IsEmpty());
  const auto from_goal = [&](Duration at) {
    const Pose2& pose = run.truth.at(static_cast<std::size_t>(at / 50ms));
    return std::hypot(pose.x - 6, pose.y);
  };
  EXPECT_GT(from_goal(10s), 1.0);
  EXPECT_LT(from_goal(70s), 0.3);
  EXPECT_DOUBLE_EQ(from_goal(119s), from_goal(70s));
}

TEST(BehaviourDemoTest, AllocatesNothingAfterStartUp) {
  if (!AllocationGuard::works()) GTEST_SKIP() << "sanitizers have a malloc of their own";
  constexpr int kStartUp = 40;
  int cycles = 0;
  std::size_t allocations = 0;
  std::optional<AllocationGuard> guard;
  ApplicationChoice choice = Demo("one_obstacle");
  choice.before_step = [&] { guard.emplace(); };
  choice.after_step = [&] {
    if (++cycles > kStartUp) allocations += guard->allocations();
  };
  const auto run = RunApplication(choice);
  ASSERT_TRUE(run.outcome);
  EXPECT_GT(cycles, 10 * kStartUp);
  EXPECT_EQ(allocations, 0u);
}

TEST(BehaviourSwapTest, TakesTurnsWithPlannersWhileTheRobotDrives) {
  ApplicationChoice choice = BugDemo("rooms");
  Duration at = 5s;
  for (const char* type : {"behaviours/navigator", "planning/bug2", "behaviours/navigator", "planning/tangent_bug",
                           "behaviours/navigator", "planning/bug1", "behaviours/navigator"}) {
    choice.changes.push_back({at, {ReplaceModule{.path = "/robot/planner", .type = type}}});
    at += 8s;
  }
  const ApplicationRun run = RunApplication(choice);
  ASSERT_TRUE(run.outcome);
  EXPECT_EQ(run.outcome->verdict, "reached") << run.outcome->summary;
  EXPECT_THAT(run.faults, IsEmpty());
}

}  // namespace
}  // namespace runnel::test

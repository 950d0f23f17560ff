// Modules are exchanged while the robot drives.

#include <cmath>
#include <cstring>

#include <gmock/gmock.h>

#include "tests/integration/application_run.h"

namespace runnel::test {
namespace {

using namespace std::chrono_literals;
using testing::IsEmpty;

ReplaceModule Planner(const std::string& type) { return {.path = "/robot/planner", .type = "planning/" + type}; }

std::string World(const std::string& name) { return "world=" RUNNEL_XML "/worlds/" + name + ".xml"; }

TEST(SwapTest, EveryPlannerTakesOverFromEveryOtherInTheMidstOfTheWay) {
  const char* const variants[] = {"bug1", "alg1", "dist_bug", "tangent_bug", "class1", "alg2", "rev1", "rev2", "bug2"};
  ApplicationChoice choice{.name = "bug_demo.xml", .arguments = {World("rooms"), "picture="}};
  Duration at = 7s;
  for (int round = 0; round < 4; ++round) {
    for (const char* variant : variants) {
      choice.changes.push_back({at, {Planner(variant)}});
      at += 4s;
    }
  }
  const ApplicationRun run = RunApplication(choice);
  ASSERT_TRUE(run.outcome);
  EXPECT_EQ(run.outcome->verdict, "reached") << run.outcome->summary;
  EXPECT_THAT(run.faults, IsEmpty());
}

TEST(SwapTest, TheSamePlannerMadeAnewAllTheTimeDrivesTheSameWay) {
  ApplicationChoice choice{.name = "bug_demo.xml", .arguments = {World("rooms"), "picture="}};
  const ApplicationRun undisturbed = RunApplication(choice);
  for (Duration at = 5s; at < 60s; at += 1s) choice.changes.push_back({at, {Planner("bug2")}});
  const ApplicationRun swapped = RunApplication(choice);
  ASSERT_TRUE(swapped.outcome);
  EXPECT_EQ(swapped.outcome->verdict, undisturbed.outcome->verdict);
  // A planner does not know how long ago its predecessor ran; that is all it has forgotten.
  EXPECT_NEAR(ToSeconds(swapped.duration), ToSeconds(undisturbed.duration), 5.0);
}

// Else a swap, or a reload, would open it.
TEST(SwapTest, AnotherGateKnowsThatThereWasABumper) {
  const ApplicationRun run =
      RunApplication({.name = "bug_demo.xml",
                      .arguments = {World("rooms"), "picture="},
                      .limit = 20s,
                      .changes = {{6s, {DisconnectPorts{"/bumper/contact", "/robot/contact"}}},
                                  {10s, {ReplaceModule{.path = "/robot/gate", .type = "motion/command_gate"}}}}});
  ASSERT_GE(run.truth.size(), 400u);
  EXPECT_GT(std::hypot(run.truth[119].x - run.truth[99].x, run.truth[119].y - run.truth[99].y), 0.05) << "it drives";
  for (std::size_t i = 160; i < run.truth.size(); ++i) ASSERT_EQ(run.truth[i], run.truth[159]) << i;
}

TEST(SwapTest, TheSensorIsExchangedWithItsAdaptorWhileTheRobotDrives) {
  const ChangeSet to_infrared = {
      CreateModule{"/infrared", "simulation/infrared"},
      ConnectPorts{"/world/scene", "/infrared/scene"},
      ConnectPorts{"/world/pose", "/infrared/pose"},
      CreatePort{"/robot/ranges", Port::Direction::kInput, "InfraredRanges"},
      ConnectPorts{"/infrared/ranges", "/robot/ranges"},
      DeleteElement{"/laser"},
      DeleteElement{"/robot/eyes"},
      CreateModule{"/robot/eyes", "adaptors/infrared"},
      ConnectPorts{"/robot/ranges", "/robot/eyes/ranges"},
      ConnectPorts{"/robot/pose", "/robot/eyes/pose"},
      ConnectPorts{"/robot/eyes/surroundings", "/robot/planner/surroundings"},
  };
  const ApplicationRun run = RunApplication(
      {.name = "bug_demo.xml", .arguments = {World("one_obstacle"), "picture="}, .changes = {{10s, to_infrared}}});
  ASSERT_TRUE(run.outcome);
  EXPECT_EQ(run.outcome->verdict, "reached") << run.outcome->summary;
  EXPECT_THAT(run.faults, IsEmpty());
}

TEST(SwapTest, ChangesRepeatBitForBit) {
  const ApplicationChoice choice{.name = "bug_demo.xml",
                                 .arguments = {World("cup"), "picture="},
                                 .changes = {{9s, {Planner("tangent_bug")}}, {15s, {Planner("alg1")}}}};
  const ApplicationRun first = RunApplication(choice);
  const ApplicationRun second = RunApplication(choice);
  ASSERT_EQ(first.truth.size(), second.truth.size());
  EXPECT_EQ(std::memcmp(first.truth.data(), second.truth.data(), first.truth.size() * sizeof(Pose2)), 0);
}

}  // namespace
}  // namespace runnel::test

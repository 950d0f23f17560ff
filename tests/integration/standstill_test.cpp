// A base whose commands fail to come stands still, in every demonstration.

#include <cmath>

#include <gmock/gmock.h>

#include "tests/integration/application_run.h"

namespace runnel::test {
namespace {

using namespace std::chrono_literals;
using testing::IsEmpty;

constexpr std::size_t kCyclesPerSecond = 20;

std::string World(const std::string& name) { return "world=" RUNNEL_XML "/worlds/" + name + ".xml"; }

double WayBetween(const ApplicationRun& run, std::size_t from, std::size_t to) {
  double way = 0;
  for (std::size_t i = from + 1; i <= to; ++i) {
    way += std::hypot(run.truth.at(i).x - run.truth.at(i - 1).x, run.truth.at(i).y - run.truth.at(i - 1).y);
  }
  return way;
}

class Standstill : public testing::TestWithParam<const char*> {
 protected:
  // Changes after 6 s of driving, and looks at the 12 s after that.
  void ExpectItAfter(const ChangeSet& changes) {
    const ApplicationRun run = RunApplication(
        {.name = GetParam(), .arguments = {World("rooms"), "picture="}, .limit = 18s, .changes = {{6s, changes}}});
    const std::size_t changed = 6 * kCyclesPerSecond;
    ASSERT_GT(WayBetween(run, changed - kCyclesPerSecond, changed), 0.05) << "it drives";
    // The time-out, then wheels and body come to rest: no more than 1 m/s for 1.5 s.
    const std::size_t rested = changed + 3 * kCyclesPerSecond / 2;
    EXPECT_EQ(WayBetween(run, rested, run.truth.size() - 1), 0.0);
    EXPECT_LT(WayBetween(run, changed, rested), 0.5);
    EXPECT_THAT(run.faults, IsEmpty());
    EXPECT_FALSE(run.outcome) << run.outcome->summary;
  }
};

TEST_P(Standstill, ComesWhenTheWheelsAreDisconnected) {
  ExpectItAfter({DisconnectPorts{"/robot/wheels", "/world/wheels"}});
}
TEST_P(Standstill, ComesWhenTheDriveIsDeleted) { ExpectItAfter({DeleteElement{"/robot/drive"}}); }
TEST_P(Standstill, ComesWhenTheRobotIsDeleted) { ExpectItAfter({DeleteElement{"/robot"}}); }
TEST_P(Standstill, ComesWhenThePlannerIsDeleted) { ExpectItAfter({DeleteElement{"/robot/planner"}}); }
TEST_P(Standstill, ComesWhenThePlannerIsDisconnectedFromTheGate) {
  ExpectItAfter({DisconnectPorts{"/robot/planner/twist", "/robot/gate/wanted"}});
}

INSTANTIATE_TEST_SUITE_P(Demonstrations, Standstill,
                         testing::Values("bug_demo.xml", "bug_infrared.xml", "bug_bumper.xml", "bug_failing_laser.xml"),
                         [](const auto& test) {
                           const std::string name = test.param;
                           return name.substr(0, name.find('.'));
                         });

TEST(StandstillTest, DoesNotComeWhenThePlannerOrTheDriveIsSwapped) {
  const auto way = [](const char* module, const char* type) {
    const ApplicationRun run = RunApplication({.name = "bug_demo.xml",
                                               .arguments = {World("rooms"), "picture="},
                                               .limit = 10s,
                                               .changes = {{4s, {ReplaceModule{.path = module, .type = type}}}}});
    return run.truth;
  };
  const auto planner = way("/robot/planner", "planning/bug1");
  const auto drive = way("/robot/drive", "motion/differential_drive");
  for (const auto* truth : {&planner, &drive}) {
    ASSERT_GT(truth->size(), 6 * kCyclesPerSecond);
    for (std::size_t i = 4 * kCyclesPerSecond; i < 6 * kCyclesPerSecond; ++i) {
      const auto &before = truth->at(i - 1), &after = truth->at(i);
      const double moved =
          std::hypot(after.x - before.x, after.y - before.y) + std::abs(after.heading - before.heading);
      EXPECT_GT(moved, 0.001) << i;
    }
  }
}

}  // namespace
}  // namespace runnel::test

// A module fails while the robot drives: what the robot does then is the application's choice.

#include <gmock/gmock.h>

#include "tests/integration/application_run.h"

namespace runnel::test {
namespace {

/// bug_demo with a relay between adaptor and planner that fails after 5 s.
ApplicationChoice WithFaultyRelay(const std::string& rule) {
  return {.name = "bug_demo.xml",
          .replace = {{"<load plugin=\"motion\"/>", "<load plugin=\"motion\"/> <load plugin=\"faulty\"/>"},
                      {"<module name=\"gate\"", "<module name=\"relay\" type=\"faulty/relay\"/> <module name=\"gate\""},
                      {"from=\"eyes/surroundings\" to=\"planner/surroundings\"",
                       "from=\"eyes/surroundings\" to=\"relay/in\"/> <connect from=\"relay/out\" "
                       "to=\"planner/surroundings\""},
                      {"<on_fault of=\".\" action=\"quit\"/>", rule}},
          .arguments = {"world=" RUNNEL_XML "/worlds/open.xml", "picture="},
          .limit = std::chrono::seconds(15)};
}

/// The path driven in the last `cycles` cycles.
double RecentWay(const ApplicationRun& run, std::size_t cycles) {
  const Pose2& last = run.truth.back();
  const Pose2& before = run.truth[run.truth.size() - 1 - cycles];
  return Distance(Position(last), Position(before));
}

TEST(Fault, StopsItsModuleAloneAndTheGateStopsTheRobot) {
  const auto run = RunApplication(WithFaultyRelay(""));
  EXPECT_EQ(run.duration, std::chrono::seconds(15)) << "the rest runs on";
  ASSERT_EQ(run.faults.size(), 1u) << "once, not in every cycle";
  EXPECT_THAT(run.faults[0].path, testing::EndsWith("/robot/relay"));
  EXPECT_THAT(run.faults[0].message, testing::HasSubstr("worn out"));
  EXPECT_GT(Distance(Position(run.truth.front()), Position(run.truth.back())), 1.0);
  EXPECT_LT(RecentWay(run, 100), 1e-6) << "the robot stands still";
}

TEST(Fault, StopsTheApplicationWhereItSaysSo) {
  const auto run = RunApplication(WithFaultyRelay("<on_fault of=\"robot\" action=\"quit\"/>"));
  EXPECT_TRUE(run.was_stopped);
  EXPECT_FALSE(run.outcome);
  EXPECT_LT(run.duration, std::chrono::milliseconds(5200));
}

TEST(Fault, SetsAParameterWhereItSaysSo) {
  const auto run =
      RunApplication(WithFaultyRelay("<on_fault of=\"robot/relay\" set=\"robot/gate/stop\" value=\"true\"/>"));
  EXPECT_FALSE(run.was_stopped);
  EXPECT_LT(RecentWay(run, 100), 1e-6);
}

}  // namespace
}  // namespace runnel::test

// A sensor fails while the robot drives: it goes on with another one, and reaches its goal.

#include <chrono>

#include <gmock/gmock.h>

#include "tests/integration/application_run.h"

namespace runnel::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

ApplicationRun Drive(std::vector<std::string> arguments) {
  arguments.push_back("picture=");
  return RunApplication({.name = "bug_failing_laser.xml", .arguments = std::move(arguments)});
}

TEST(FailingLaser, TheRobotGoesOnByInfraredAndReachesItsGoal) {
  const ApplicationRun run = Drive({"fails_at=8", "works_again_at=0"});
  ASSERT_TRUE(run.outcome);
  EXPECT_EQ(run.outcome->verdict, "reached") << run.outcome->summary;
  EXPECT_THAT(run.faults, IsEmpty());
  ASSERT_THAT(run.notices, SizeIs(1));
  EXPECT_FALSE(run.notices[0].is_failure) << run.notices[0].message;
  EXPECT_THAT(run.notices[0].message, HasSubstr("infrared_eyes/output/surroundings"));
  // The last scan is that of 7.95 s; the cycle at 8.3 s is the first with more than 300 ms of silence.
  EXPECT_EQ(run.notices[0].time, Time(8300ms));
}

TEST(FailingLaser, TheLaserIsTakenBackWhenItWorksAgain) {
  const ApplicationRun run = Drive({"fails_at=8", "works_again_at=15"});
  ASSERT_TRUE(run.outcome);
  EXPECT_EQ(run.outcome->verdict, "reached") << run.outcome->summary;
  ASSERT_THAT(run.notices, SizeIs(2));
  EXPECT_THAT(run.notices[1].message, HasSubstr("to /bug_failing_laser/robot/laser_eyes"));
  EXPECT_GE(run.notices[1].time, Time(16s));
  EXPECT_LE(run.notices[1].time, Time(16200ms));
}

TEST(FailingLaser, AnExceptionOfItsModuleIsAnsweredByANewModule) {
  const ApplicationRun run = Drive({"fails_at=8", "works_again_at=0", "fails_loudly=true"});
  ASSERT_TRUE(run.outcome);
  EXPECT_EQ(run.outcome->verdict, "reached") << run.outcome->summary;
  ASSERT_FALSE(run.faults.empty());
  ASSERT_FALSE(run.notices.empty());
  EXPECT_THAT(run.notices[0].message, HasSubstr("replaced /bug_failing_laser/laser"));
  EXPECT_FALSE(run.was_stopped);
}

}  // namespace
}  // namespace runnel::test

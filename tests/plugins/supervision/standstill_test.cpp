// Ports that drive, while what feeds them does not run.

#include <future>

#include "tests/plugins/supervision/supervised_robot.h"

namespace runnel::supervised {
namespace {

TEST_F(Driven, APortHasItsSafeValueWhileWhatFeedsItIsPaused) {
  MustSucceed(robot.supervisor.SetPaused("/laser", true));
  EXPECT_THAT(robot.Messages(), ElementsAre("has its safe value: /laser is paused"));
  RunOn();
  EXPECT_EQ(robot.seen, -7);
  robot.laser_works = false;
  MustSucceed(robot.supervisor.SetPaused("/laser", false));
  RunOn();
  EXPECT_EQ(robot.seen, -7) << "the command of before moves nothing";
  robot.laser_works = true;
  RunOn();
  EXPECT_EQ(robot.seen, 1);
  EXPECT_THAT(robot.Messages(), ElementsAre(HasSubstr("is driven again")));
}

TEST_F(Driven, APortHasItsSafeValueWhenWhatFeedsItHasFailed) {
  robot.laser_throws = true;
  RunOn();
  EXPECT_EQ(robot.seen, -7);
  EXPECT_THAT(robot.Messages(), ElementsAre("has its safe value: /laser has failed"));
  MustSucceed(Port::Disconnect(robot.laser.out, robot.reader.in));
  MustSucceed(Port::Connect(robot.infrared.out, robot.reader.in));
  RunOn();
  EXPECT_EQ(robot.seen, 2) << "another one feeds it";
}

TEST_F(Driven, WhatAPersonHasSetStaysAndWhatIsReleasedMeanwhileIsSafeAgain) {
  const double nine = 9;
  MustSucceed(PublishByHand(robot.reader.in, &nine));
  MustSucceed(robot.supervisor.SetPaused("/laser", true));
  RunOn();
  EXPECT_EQ(robot.seen, 9);
  EXPECT_TRUE(robot.reader.in.Release());
  EXPECT_TRUE(robot.reader.in.Release(Port::Setter::kRule));
  RunOn();
  EXPECT_EQ(robot.seen, -7);
}

TEST_F(Driven, WhatARuleHasSetIsTheRulesToTakeBack) {
  MustSucceed(robot.supervisor.Add(SupervisionRule{
      .when = SupervisionRule::When::kPaused, .of = "/infrared", .reaction = {.published = {{"/reader/in", "5"}}}}));
  MustSucceed(robot.supervisor.SetPaused("/laser", true));
  MustSucceed(robot.supervisor.SetPaused("/infrared", true));
  RunOn();
  EXPECT_EQ(robot.seen, 5);
  MustSucceed(robot.supervisor.SetPaused("/laser", false));
  RunOn();
  EXPECT_EQ(robot.seen, 5);
}

TEST_F(Driven, ACommandFromBeforeThePauseDoesNotDriveWhenTheRuleTakesItsValueBack) {
  SupervisionRule rule{
      .when = SupervisionRule::When::kPaused, .of = "/laser", .reaction = {.published = {{"/reader/in", "5"}}}};
  rule.otherwise.TakeBack(rule.reaction);
  MustSucceed(robot.supervisor.Add(rule));
  MustSucceed(robot.supervisor.SetPaused("/laser", true));
  RunOn();
  EXPECT_EQ(robot.seen, 5);
  robot.laser_works = false;
  MustSucceed(robot.supervisor.SetPaused("/laser", false));
  RunOn();
  EXPECT_EQ(robot.seen, -7);
  robot.laser_works = true;
  RunOn();
  EXPECT_EQ(robot.seen, 1);
}

// What is old does not wake it, nor does that nothing comes.
TEST_F(Driven, AModuleThatWaitsForDataFindsThatNoneComes) {
  AssignThread(robot.reader, OnlyOnData());
  MustSucceed(robot.runtime.MakeReady(robot.runtime.root()));
  robot.seen = 0;
  robot.laser_works = false;
  RunOn();
  EXPECT_EQ(robot.seen, 1) << "it has been run, and reads what came last";
}

// One thread runs them all then.
TEST_F(Driven, OnASimulatedClockItIsTheSameWhileAModuleOfAnotherThreadIsStuck) {
  std::atomic<bool> hangs{true};
  auto& other = robot.runtime.Create<Doing>(robot.runtime.root(), "other");
  other.action = [&](Doing&) { hangs.wait(true); };
  AssignThread(other, CreateThread(robot.runtime, "apart", {.period = 10ms}));
  MustSucceed(robot.runtime.MakeReady(robot.runtime.root()));
  MustSucceed(robot.scheduler.SetStuckLimit("", 50ms));
  std::jthread runs([&] { (void)robot.scheduler.RunUntil(At(300)); });
  WaitUntil("it has its safe value", [&] {
    robot.supervisor.KeepSafe();
    const std::lock_guard lock(robot.runtime.structure_mutex());
    return robot.reader.in.is_set_by_hand(Port::Setter::kRule);
  });
  hangs = false;
  hangs.notify_all();
}

TEST(StandstillInRealTime, APortHasItsSafeValueWhileTheThreadOfWhatFeedsItIsStuck) {
  Robot robot(SchedulerOptions::ClockKind::kReal);
  std::atomic<bool> hangs{false};
  auto& other = robot.runtime.Create<Doing>(robot.runtime.root(), "other");
  other.action = [&](Doing&) { hangs.wait(true); };
  auto& apart = CreateThread(robot.runtime, "apart", {.period = 10ms});
  AssignThread(other, apart);
  AssignThread(robot.laser, apart);
  MustSucceed(robot.runtime.MakeReady(robot.runtime.root()));
  MustSucceed(
      robot.reader.in.SetDriving(true, {TypeOf<double>(), std::make_shared<double>(-7)}, {}, DrivingKind::kEffort));
  MustSucceed(robot.scheduler.SetStuckLimit("", 50ms));
  MustSucceed(robot.scheduler.Start());
  WaitUntil("the laser is seen", [&] { return robot.seen == 1; });
  hangs = true;
  WaitUntil("the safe value is seen", [&] { return robot.seen == -7; });
  EXPECT_THAT(robot.Messages(), ::testing::Contains(HasSubstr("which runs /laser, does not return")));
  hangs = false;
  hangs.notify_all();
  WaitUntil("the laser is seen again", [&] { return robot.seen == 1; });
  robot.scheduler.Stop();
}

// As where a constructor takes 5 s.
TEST(StandstillInRealTime, AChangeThatTakesLongKeepsUpNoOtherRule) {
  Robot robot(SchedulerOptions::ClockKind::kReal);
  std::atomic<bool> is_changing{false}, hangs{true}, throws{false};
  robot.before_changes = [&] {
    is_changing = true;
    hangs.wait(true);
  };
  robot.infrared.action = [&](Doing&) {
    if (throws) throw std::runtime_error("no answer");
  };
  MustSucceed(robot.supervisor.Add(robot.SwitchingRule()));
  MustSucceed(robot.supervisor.Add(SupervisionRule{
      .when = SupervisionRule::When::kFault, .of = "/infrared", .reaction = {.published = {{"/reader/in", "5"}}}}));
  MustSucceed(robot.scheduler.Start());
  WaitUntil("the laser is seen", [&] { return robot.seen == 1; });
  robot.laser_works = false;
  WaitUntil("the change is under way", [&] { return is_changing.load(); });
  throws = true;
  WaitUntil("the safe value is seen", [&] { return robot.seen == 5; });
  hangs = false;
  hangs.notify_all();
  robot.scheduler.Stop();
}

TEST(StandstillInRealTime, APauseWaitsForNoOtherOne) {
  Robot robot(SchedulerOptions::ClockKind::kReal);
  std::atomic<bool> hangs{false}, is_hanging{false};
  auto& other = robot.runtime.Create<Doing>(robot.runtime.root(), "other");
  other.action = [&](Doing&) {
    is_hanging = hangs.load();
    if (is_hanging) hangs.wait(true);
  };
  AssignThread(other, CreateThread(robot.runtime, "apart", {.period = 10ms}));
  MustSucceed(robot.runtime.MakeReady(robot.runtime.root()));
  MustSucceed(
      robot.reader.in.SetDriving(true, {TypeOf<double>(), std::make_shared<double>(-7)}, {}, DrivingKind::kEffort));
  MustSucceed(robot.scheduler.Start());
  WaitUntil("the laser is seen", [&] { return robot.seen == 1; });
  hangs = true;
  WaitUntil("the other one is in a long cycle", [&] { return is_hanging.load(); });
  const auto pause = [&robot](const char* path) {
    return std::async(std::launch::async,
                      [&robot, path] { return robot.supervisor.SetPaused(path, true).has_value(); });
  };
  auto first = pause("/other");
  WaitUntil("it is paused from its next cycle on", [&] { return robot.scheduler.IsPaused(other); });
  auto second = pause("/laser");
  WaitUntil("the safe value is seen", [&] { return robot.seen == -7; });
  EXPECT_EQ(first.wait_for(0s), std::future_status::timeout) << "it still waits for the end of the cycle";
  EXPECT_TRUE(second.get());
  hangs = false;
  hangs.notify_all();
  first.get();
  robot.scheduler.Stop();
}

TEST_F(Driven, ThatNoStopReachesAPortIsToldWhileItsOwnModuleIsPausedAndThatOneDoesAgain) {
  MustSucceed(robot.supervisor.SetPaused("/reader", true));
  EXPECT_THAT(robot.Messages(),
              ElementsAre(HasSubstr("cannot be reached: /reader is paused; until it runs, no STOP counts there")));
  RunOn();
  EXPECT_THAT(robot.Messages(), IsEmpty());
  MustSucceed(robot.supervisor.SetPaused("/reader", false));
  RunOn();
  EXPECT_THAT(robot.Messages(), ElementsAre("can be reached again"));
}

TEST_F(Driven, ThatStampsAreStillToComeIsToldOnce) {
  robot.laser.out.Publish(1, robot.runtime.clock().Now() + 1h);
  RunOn();
  EXPECT_THAT(robot.Messages(), ElementsAre(HasSubstr("bears times of measurement that are still to come")));
  robot.laser.out.Publish(1, robot.runtime.clock().Now() + 1h);
  MustSucceed(robot.supervisor.SetPaused("/infrared", true));  // it looks at the structure anew
  RunOn();
  EXPECT_THAT(robot.Messages(), IsEmpty());
}

// Long before a rule would tell that the module is stuck.
TEST(StandstillInRealTime, ThatNoStopReachesAPortIsToldWhileItsThreadIsStuck) {
  Robot robot(SchedulerOptions::ClockKind::kReal);
  std::atomic<bool> hangs{false};
  auto& other = robot.runtime.Create<Doing>(robot.runtime.root(), "other");
  other.action = [&](Doing&) { hangs.wait(true); };
  auto& apart = CreateThread(robot.runtime, "apart", {.period = 10ms});
  AssignThread(other, apart);
  AssignThread(robot.reader, apart);
  MustSucceed(robot.runtime.MakeReady(robot.runtime.root()));
  MustSucceed(
      robot.reader.in.SetDriving(true, {TypeOf<double>(), std::make_shared<double>(-7)}, {}, DrivingKind::kEffort));
  MustSucceed(robot.scheduler.SetStuckLimit("", 1h));
  MustSucceed(robot.scheduler.Start());
  WaitUntil("the laser is seen", [&] { return robot.seen == 1; });
  hangs = true;
  std::vector<std::string> told;
  WaitUntil("it is told", [&] { return !(told = robot.Messages()).empty(); });
  EXPECT_THAT(
      told,
      ElementsAre(HasSubstr("cannot be reached: a module of /threads/apart, which runs /reader, does not return")));
  {
    const std::lock_guard lock(robot.runtime.structure_mutex());
    EXPECT_THAT(robot.scheduler.WhyUnreached(robot.reader.in), HasSubstr("does not return"));
    EXPECT_EQ(robot.scheduler.WhyUnreached(robot.laser.in), "");
  }
  hangs = false;
  hangs.notify_all();
  WaitUntil("it is well again", [&] { return !(told = robot.Messages()).empty(); });
  EXPECT_THAT(told, ElementsAre("can be reached again"));
  robot.scheduler.Stop();
}

}  // namespace
}  // namespace runnel::supervised

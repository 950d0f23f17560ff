// Inputs that fall silent and modules that fail, on the simulated clock and on the real one.

#include "tests/plugins/supervision/notices.h"
#include "tests/plugins/supervision/supervised_robot.h"

namespace runnel::supervised {
namespace {

TEST_F(Supervised, InputsThatFallSilentAreFedByAnotherSourceAndGetTheirsBack) {
  MustSucceed(robot.supervisor.Add(robot.SwitchingRule()));
  robot.scheduler.RunUntil(At(100));
  EXPECT_EQ(robot.seen, 1);
  EXPECT_THAT(test::NoticesOf(robot.supervisor), IsEmpty());
  robot.laser_works = false;  // last heard at 90 ms
  robot.scheduler.RunUntil(At(130));
  EXPECT_THAT(test::NoticesOf(robot.supervisor), IsEmpty());
  robot.scheduler.RunUntil(At(150));
  EXPECT_EQ(robot.seen, 2);
  const auto notices = test::NoticesOf(robot.supervisor);
  ASSERT_THAT(notices, SizeIs(1));
  EXPECT_EQ(notices[0].path, robot.reader.in.path());
  EXPECT_EQ(notices[0].time, At(130));
  EXPECT_FALSE(notices[0].is_failure);
  EXPECT_THAT(notices[0].message, HasSubstr("switched to infrared"));
  robot.laser_works = true;
  robot.scheduler.RunUntil(At(300));
  EXPECT_EQ(robot.seen, 1);
  EXPECT_THAT(robot.Messages(), ElementsAre(HasSubstr("switched to the laser")));
}

TEST_F(Supervised, WhatIsOldWhenItComesIsStale) {
  MustSucceed(robot.supervisor.Add(robot.SwitchingRule()));
  Duration lag = 20ms;
  robot.laser.action = [&](Doing& module) { module.out.Publish(1, module.cycle_time() - lag); };
  robot.scheduler.RunUntil(At(200));
  EXPECT_THAT(robot.Messages(), IsEmpty());
  lag = 40ms;
  robot.scheduler.RunUntil(At(250));
  EXPECT_THAT(robot.Messages(), ElementsAre(HasSubstr("switched to infrared")));
  lag = -1h;  // a wrong clock does not make it fresh for ever
  robot.scheduler.RunUntil(At(400));
  EXPECT_THAT(robot.Messages(), ElementsAre(HasSubstr("still to come"), HasSubstr("switched to the laser")));
  robot.laser.action = [](Doing&) {};
  robot.scheduler.RunUntil(At(500));
  EXPECT_THAT(robot.Messages(), ElementsAre(HasSubstr("switched to infrared")));
}

TEST_F(Supervised, InputsAreNotFreshBeforeTheyHaveBeenForAWhile) {
  MustSucceed(robot.supervisor.Add(robot.SwitchingRule()));
  robot.laser_works = false;
  robot.scheduler.RunUntil(At(100));
  EXPECT_THAT(robot.Messages(), SizeIs(1));
  for (int time = 100; time < 1000; time += 100) {  // 30 ms of every 100 ms
    robot.laser_works = true;
    robot.scheduler.RunUntil(At(time + 30));
    robot.laser_works = false;
    robot.scheduler.RunUntil(At(time + 100));
  }
  EXPECT_THAT(robot.Messages(), IsEmpty());
  EXPECT_EQ(robot.seen, 2);
}

TEST_F(Supervised, AModuleThatThrowsIsAnsweredAtOnce) {
  MustSucceed(robot.supervisor.Add(
      SupervisionRule{.when = SupervisionRule::When::kFault,
                      .of = robot.laser.path(),
                      .reaction = {.changes = Switch(robot.reader.in, robot.laser.out, robot.infrared.out),
                                   .description = "switched to infrared"}}));
  robot.scheduler.RunUntil(At(50));
  robot.laser_throws = true;
  robot.scheduler.RunUntil(At(70));
  EXPECT_EQ(robot.seen, 2);
  EXPECT_THAT(robot.Messages(), ElementsAre(HasSubstr("switched to infrared")));
  EXPECT_FALSE(robot.scheduler.stop_requested());
}

TEST_F(Supervised, AReactionMayEndTheRun) {
  SupervisionRule rule = robot.SwitchingRule();
  rule.reaction = {.ends_run = true};
  MustSucceed(robot.supervisor.Add(rule));
  robot.laser_works = false;
  EXPECT_FALSE(robot.scheduler.RunUntil(At(1000)));
  EXPECT_TRUE(robot.scheduler.ended_by_fault());
  EXPECT_THAT(robot.Messages(), ElementsAre(HasSubstr("ends the run")));
}

TEST_F(Supervised, WhatCannotBeDoneIsToldAndTheRestRunsOn) {
  SupervisionRule rule = robot.SwitchingRule();
  rule.reaction.changes = {ConnectPorts{"/infrared/nothing", robot.reader.in.path()}};
  MustSucceed(robot.supervisor.Add(rule));
  robot.laser_works = false;
  EXPECT_TRUE(robot.scheduler.RunUntil(At(200)));
  const auto notices = test::NoticesOf(robot.supervisor);
  ASSERT_THAT(notices, SizeIs(1));
  EXPECT_TRUE(notices[0].is_failure);
  EXPECT_THAT(notices[0].message, HasSubstr("'nothing'"));
}

TEST_F(Supervised, RulesForWhatIsNotThereAreRefused) {
  SupervisionRule rule = robot.SwitchingRule();
  rule.of = "/reader/inn";
  EXPECT_FALSE(robot.supervisor.Add(rule));
  rule.of = robot.infrared.in.path();  // nothing feeds it
  const auto added = robot.supervisor.Add(rule);
  ASSERT_FALSE(added);
  EXPECT_THAT(added.error().message, HasSubstr("nothing is connected"));
  rule = robot.SwitchingRule();
  rule.after = 0ms;
  EXPECT_FALSE(robot.supervisor.Add(rule));
}

TEST_F(Supervised, ATimeOutOfCenturiesNeverComes) {
  SupervisionRule rule = robot.SwitchingRule();
  rule.after = Duration::max();
  MustSucceed(robot.supervisor.Add(rule));
  robot.scheduler.RunUntil(At(100));
  robot.laser_works = false;
  robot.scheduler.RunUntil(At(100'000));
  EXPECT_THAT(robot.Messages(), IsEmpty());
  EXPECT_EQ(robot.seen, 1);
}

// Both hold the same port; what each of them has set stays for as long as it is in force.
TEST_F(Supervised, ARuleThatTakesItsValueBackLeavesWhatAnotherOneHolds) {
  const auto add = [this](const Port& watched, const std::string& value) {
    SupervisionRule rule = robot.SwitchingRule();
    rule.of = watched.path();
    rule.reaction = {.published = {{robot.reader.in.path(), value}}};
    rule.otherwise = {};
    rule.otherwise.TakeBack(rule.reaction);
    MustSucceed(robot.supervisor.Add(rule));
  };
  bool infrared_works = true;
  robot.infrared.action = [&](Doing& module) {
    if (infrared_works) module.out.Publish(2);
  };
  add(robot.reader.in, "5");
  add(robot.infrared.out, "6");
  robot.scheduler.RunUntil(At(100));
  infrared_works = false;
  robot.scheduler.RunUntil(At(200));
  EXPECT_EQ(robot.seen, 6);
  robot.laser_works = false;
  robot.scheduler.RunUntil(At(300));
  EXPECT_EQ(robot.seen, 5);
  robot.laser_works = true;
  robot.scheduler.RunUntil(At(500));
  EXPECT_EQ(robot.seen, 6) << "infrared is silent still";
  infrared_works = true;
  robot.scheduler.RunUntil(At(700));
  EXPECT_EQ(robot.seen, 1);
}

// What is done about it may not do, and still the other rule's is done.
TEST_F(Supervised, AReactionThatThrowsKeepsNeitherOthersNorTheEndOfTheRunAway) {
  Supervisor throwing(robot.runtime, robot.scheduler,
                      [](const ChangeSet&) -> Result<ChangeSet> { throw std::runtime_error("no memory"); });
  SupervisionRule rule = robot.SwitchingRule();
  rule.reaction.ends_run = true;
  MustSucceed(throwing.Add(rule));
  robot.laser_works = false;
  EXPECT_FALSE(robot.scheduler.RunUntil(At(200)));
  const auto notices = test::NoticesOf(throwing);
  ASSERT_THAT(notices, SizeIs(1));
  EXPECT_TRUE(notices[0].is_failure);
  EXPECT_THAT(notices[0].message, HasSubstr("no memory"));
}

TEST_F(Supervised, ARuleThatTakesItsValueBackLeavesWhatAPersonHasSet) {
  SupervisionRule rule = robot.SwitchingRule();
  rule.reaction = {.published = {{robot.reader.in.path(), "5"}}};
  rule.otherwise = {};
  rule.otherwise.TakeBack(rule.reaction);
  MustSucceed(robot.supervisor.Add(rule));
  robot.laser_works = false;
  robot.scheduler.RunUntil(At(100));
  EXPECT_EQ(robot.seen, 5);
  const double nine = 9;
  MustSucceed(PublishByHand(robot.reader.in, &nine));
  robot.scheduler.RunUntil(At(150));
  EXPECT_EQ(robot.seen, 9) << "a person's value wins";
  robot.laser_works = true;
  robot.scheduler.RunUntil(At(400));
  EXPECT_THAT(robot.Messages(), SizeIs(2)) << "it is fresh again";
  EXPECT_EQ(robot.seen, 9);
  EXPECT_TRUE(robot.reader.in.Release());
  robot.scheduler.RunUntil(At(450));
  EXPECT_EQ(robot.seen, 1);
}

TEST_F(Driven, ARuleThatTakesItsValueBackEndsNeitherABlockNorAStop) {
  Port& port = robot.reader.in;
  SupervisionRule rule = robot.SwitchingRule();
  rule.reaction = {.published = {{port.path(), "5"}}};
  rule.otherwise = {};
  rule.otherwise.TakeBack(rule.reaction);
  MustSucceed(robot.supervisor.Add(rule));
  RobotStop& stop = robot.runtime.robot_stop();
  const auto block = [&] { MustSucceed(port.Block()); };
  const auto press = [&] { EXPECT_TRUE(stop.Press("a person")); };
  for (const std::function<void()>& hold : {std::function<void()>(block), std::function<void()>(press)}) {
    robot.laser_works = false;
    RunOn();
    ASSERT_EQ(robot.seen, 5);
    hold();
    RunOn();
    EXPECT_EQ(robot.seen, -7);
    robot.laser_works = true;
    RunOn();
    EXPECT_FALSE(port.is_set_by_hand(Port::Setter::kRule)) << "it is fresh again";
    EXPECT_EQ(robot.seen, -7);
    EXPECT_EQ(port.is_blocked(), !stop.in_force());
    const bool is_ended = port.is_blocked() ? port.Unblock() : stop.Release("a person").has_value();
    EXPECT_TRUE(is_ended);
    RunOn();
    EXPECT_EQ(robot.seen, 1);
  }
}

TEST_F(Supervised, ARuleThatCannotTakeItsValueBackSaysSo) {
  SupervisionRule rule = robot.SwitchingRule();
  rule.reaction = {.published = {{robot.reader.in.path(), "5"}}};
  rule.otherwise = {.released = {"/was_renamed/in"}};
  MustSucceed(robot.supervisor.Add(rule));
  robot.laser_works = false;
  robot.scheduler.RunUntil(At(100));
  robot.laser_works = true;
  robot.scheduler.RunUntil(At(400));
  EXPECT_THAT(robot.Messages(), ElementsAre(HasSubstr("nothing new"), HasSubstr("was_renamed")));
}

TEST_F(Supervised, AThreadThatOverrunsIsToldOnceAndThatItKeepsItsPeriodAgain) {
  robot.scheduler.RunUntil(At(1500));
  EXPECT_THAT(robot.Messages(), IsEmpty());
  robot.infrared.action = [&](Doing& of) { robot.scheduler.simulated_clock().Set(of.cycle_time() + 15ms); };
  robot.scheduler.RunUntil(At(5000));
  const auto late = test::NoticesOf(robot.supervisor);
  ASSERT_THAT(late, SizeIs(1));
  EXPECT_EQ(late[0].path, robot.thread.path());
  EXPECT_THAT(late[0].message, HasSubstr("overruns: "));
  robot.infrared.action = [](Doing&) {};
  robot.scheduler.RunUntil(At(8000));
  EXPECT_THAT(robot.Messages(), ElementsAre("keeps its period again"));
}

// What is latched, such as a goal, sets off the module that is fed by it from now on.
TEST_F(Supervised, AModuleThatRunsOnDataIsSetOffByTheSourceThatItIsSwitchedTo) {
  int runs = 0;
  double value = 0;
  auto& latched = robot.runtime.Create<Relay>(robot.runtime.root(), "latched");
  auto& listener = robot.runtime.Create<Doing>(robot.runtime.root(), "listener");
  listener.action = [&](Doing& module) {
    ++runs;
    value = module.in.Get();
  };
  AssignThread(listener, CreateThread(robot.runtime, "waiting", {.activation = ThreadOptions::Activation::kTrigger}));
  AssignThread(latched, OnlyOnData());
  MustSucceed(Port::Connect(robot.laser.out, listener.in));
  MustSucceed(robot.runtime.MakeReady(robot.runtime.root()));
  latched.out.Publish(3);
  MustSucceed(robot.supervisor.Add(
      SupervisionRule{.of = listener.in.path(),
                      .after = 30ms,
                      .fresh_after = 50ms,
                      .reaction = {.changes = Switch(listener.in, robot.laser.out, latched.out)}}));
  robot.scheduler.RunUntil(At(95));
  robot.laser_works = false;
  const int runs_then = runs;
  robot.scheduler.RunUntil(At(1000));
  EXPECT_EQ(runs, runs_then + 1);
  EXPECT_EQ(value, 3);
}

TEST_F(Supervised, TheSameHappensInEveryRun) {
  const auto run = [] {
    Robot another(SchedulerOptions::ClockKind::kSimulated);
    MustSucceed(another.supervisor.Add(another.SwitchingRule()));
    std::vector<Time> times;
    for (int step = 0; step < 40; ++step) {
      another.laser_works = step % 13 < 6;
      another.scheduler.RunUntil(At(10 * step));
      for (const Notice& notice : test::NoticesOf(another.supervisor)) times.push_back(notice.time);
    }
    return times;
  };
  const auto first = run();
  EXPECT_FALSE(first.empty());
  EXPECT_EQ(run(), first);
}

TEST(SupervisedInRealTime, InputsAreSwitchedWhileThreadsRun) {
  Robot robot(SchedulerOptions::ClockKind::kReal);
  MustSucceed(robot.supervisor.Add(robot.SwitchingRule()));
  MustSucceed(robot.scheduler.Start());
  WaitUntil("the laser is seen", [&] { return robot.seen == 1; });
  robot.laser_works = false;
  WaitUntil("the infrared sensor is seen", [&] { return robot.seen == 2; });
  robot.laser_works = true;
  WaitUntil("the laser is seen again", [&] { return robot.seen == 1; });
  robot.scheduler.Stop();
}

}  // namespace
}  // namespace runnel::supervised

// Inputs that fall silent and modules that fail, on the simulated clock and on the real one.

#include "plugins/supervision/supervisor.h"

#include <atomic>

#include <gmock/gmock.h>

#include "plugins/structure/structure_editor.h"
#include "plugins/structure/value_by_hand.h"
#include "tests/plugins/scheduling/test_modules.h"
#include "tests/support/wait_until.h"

namespace runnel {
namespace {

using namespace std::chrono_literals;
using test::WaitUntil;
using testing::At;
using testing::Doing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::MustSucceed;
using testing::Relay;
using ::testing::SizeIs;

ChangeSet Switch(const Port& input, const Port& from, const Port& to) {
  return {DisconnectPorts{from.path(), input.path()}, ConnectPorts{to.path(), input.path()}};
}

/// Two sensors that say which they are as long as they work, and a reader that is fed by the first.
struct Robot {
  explicit Robot(SchedulerOptions::ClockKind clock) : scheduler(runtime, {.clock = clock}) {
    laser.action = [this](Doing& module) {
      if (laser_throws) throw std::runtime_error("no answer");
      if (laser_works) module.out.Publish(1);
    };
    infrared.action = [](Doing& module) { module.out.Publish(2); };
    reader.action = [this](Doing& module) { seen = module.in.Get(); };
    MustSucceed(Port::Connect(laser.out, reader.in));
    MustSucceed(runtime.MakeReady(runtime.root()));
  }
  StaleRule SwitchingRule() {
    return {.input = reader.in.path(),
            .after = 30ms,
            .fresh_after = 50ms,
            .on_stale = {.changes = Switch(reader.in, laser.out, infrared.out),
                         .description = "switched to infrared"},
            .on_fresh = {.changes = Switch(reader.in, infrared.out, laser.out),
                         .description = "switched to the laser"}};
  }
  std::vector<std::string> Messages() {
    std::vector<std::string> messages;
    for (const Notice& notice : supervisor.TakeNotices()) messages.push_back(notice.message);
    return messages;
  }

  Runtime runtime;
  ModuleRegistry modules;
  ThreadContainer& thread = CreateThread(runtime, "main", {.period = 10ms});
  Doing& laser = runtime.Create<Doing>(runtime.root(), "laser");
  Doing& infrared = runtime.Create<Doing>(runtime.root(), "infrared");
  Doing& reader = runtime.Create<Doing>(runtime.root(), "reader");
  std::atomic<bool> laser_works{true};
  std::atomic<bool> laser_throws{false};
  std::atomic<double> seen{0};
  Scheduler scheduler;
  StructureEditor editor{runtime, modules, &scheduler};
  Supervisor supervisor{runtime, scheduler, [this](const ChangeSet& changes) -> Result<void> {
                          const ChangeOutcome outcome = editor.Apply(changes);
                          if (!outcome) return outcome.diagnostics.errors().front();
                          return {};
                        }};
};

class Supervised : public ::testing::Test {
 protected:
  // A thread in which nothing runs of itself.
  ThreadContainer& OnlyOnData() {
    return CreateThread(robot.runtime, "idle", {.activation = ThreadOptions::Activation::kTrigger});
  }
  Robot robot{SchedulerOptions::ClockKind::kSimulated};
};

TEST_F(Supervised, InputsThatFallSilentAreFedByAnotherSourceAndGetTheirsBack) {
  MustSucceed(robot.supervisor.Add(robot.SwitchingRule()));
  robot.scheduler.RunUntil(At(100));
  EXPECT_EQ(robot.seen, 1);
  EXPECT_THAT(robot.supervisor.TakeNotices(), IsEmpty());
  robot.laser_works = false;  // last heard at 90 ms
  robot.scheduler.RunUntil(At(130));
  EXPECT_THAT(robot.supervisor.TakeNotices(), IsEmpty());
  robot.scheduler.RunUntil(At(150));
  EXPECT_EQ(robot.seen, 2);
  const auto notices = robot.supervisor.TakeNotices();
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
  EXPECT_THAT(robot.Messages(), ElementsAre(HasSubstr("switched to the laser")));
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
  robot.supervisor.Add(
      FaultReaction{robot.laser.path(),
                    {.changes = Switch(robot.reader.in, robot.laser.out, robot.infrared.out),
                     .description = "switched to infrared"}});
  robot.scheduler.RunUntil(At(50));
  robot.laser_throws = true;
  robot.scheduler.RunUntil(At(70));
  EXPECT_EQ(robot.seen, 2);
  EXPECT_THAT(robot.Messages(), ElementsAre(HasSubstr("switched to infrared")));
  EXPECT_FALSE(robot.scheduler.stop_requested());
}

TEST_F(Supervised, AReactionMayEndTheRun) {
  StaleRule rule = robot.SwitchingRule();
  rule.on_stale = {.stops_application = true};
  MustSucceed(robot.supervisor.Add(rule));
  robot.laser_works = false;
  EXPECT_FALSE(robot.scheduler.RunUntil(At(1000)));
  EXPECT_TRUE(robot.scheduler.stopped_by_fault());
  EXPECT_THAT(robot.Messages(), ElementsAre(HasSubstr("stops the application")));
}

TEST_F(Supervised, WhatCannotBeDoneIsToldAndTheRestRunsOn) {
  StaleRule rule = robot.SwitchingRule();
  rule.on_stale.changes = {ConnectPorts{"/infrared/nothing", robot.reader.in.path()}};
  MustSucceed(robot.supervisor.Add(rule));
  robot.laser_works = false;
  EXPECT_TRUE(robot.scheduler.RunUntil(At(200)));
  const auto notices = robot.supervisor.TakeNotices();
  ASSERT_THAT(notices, SizeIs(1));
  EXPECT_TRUE(notices[0].is_failure);
  EXPECT_THAT(notices[0].message, HasSubstr("'nothing'"));
}

TEST_F(Supervised, RulesForWhatIsNotThereAreRefused) {
  StaleRule rule = robot.SwitchingRule();
  rule.input = "/reader/inn";
  EXPECT_FALSE(robot.supervisor.Add(rule));
  rule.input = robot.infrared.in.path();  // nothing feeds it
  const auto added = robot.supervisor.Add(rule);
  ASSERT_FALSE(added);
  EXPECT_THAT(added.error().message, HasSubstr("nothing is connected"));
  rule = robot.SwitchingRule();
  rule.after = 0ms;
  EXPECT_FALSE(robot.supervisor.Add(rule));
}

TEST_F(Supervised, ATimeOutOfCenturiesNeverComes) {
  StaleRule rule = robot.SwitchingRule();
  rule.after = Duration::max();
  MustSucceed(robot.supervisor.Add(rule));
  robot.scheduler.RunUntil(At(100));
  robot.laser_works = false;
  robot.scheduler.RunUntil(At(100'000));
  EXPECT_THAT(robot.Messages(), IsEmpty());
  EXPECT_EQ(robot.seen, 1);
}

TEST_F(Supervised, ARuleThatTakesItsValueBackLeavesWhatAPersonHasSet) {
  StaleRule rule = robot.SwitchingRule();
  rule.on_stale = {.published = {{robot.reader.in.path(), "5"}}};
  rule.on_fresh = {};
  rule.on_fresh.TakeBack(rule.on_stale);
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

TEST_F(Supervised, ARuleThatCannotTakeItsValueBackSaysSo) {
  StaleRule rule = robot.SwitchingRule();
  rule.on_stale = {.published = {{robot.reader.in.path(), "5"}}};
  rule.on_fresh = {.released = {"/was_renamed/in"}};
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
  robot.infrared.action = [&](Doing& of) {
    robot.scheduler.simulated_clock().Set(of.cycle_time() + 15ms);
  };
  robot.scheduler.RunUntil(At(5000));
  const auto late = robot.supervisor.TakeNotices();
  ASSERT_THAT(late, SizeIs(1));
  EXPECT_EQ(late[0].path, robot.thread.path());
  EXPECT_THAT(late[0].message, HasSubstr("overruns: "));
  robot.infrared.action = [](Doing&) {};
  robot.scheduler.RunUntil(At(8000));
  EXPECT_THAT(robot.Messages(), ElementsAre("keeps its period again"));
}

/// Something moves by what the reader reads from the laser.
class Driven : public Supervised {
 protected:
  Driven() {
    MustSucceed(robot.reader.in.SetDriving(true, {TypeOf<double>(), std::make_shared<double>(-7)}));
    robot.scheduler.RunUntil(At(100));
    EXPECT_EQ(robot.seen, 1);
  }
  void RunOn() { robot.scheduler.RunUntil(robot.runtime.clock().Now() + 200ms); }
};

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
  robot.supervisor.Add(
      PauseReaction{.of = "/infrared", .on_pause = {.published = {{"/reader/in", "5"}}}});
  MustSucceed(robot.supervisor.SetPaused("/laser", true));
  MustSucceed(robot.supervisor.SetPaused("/infrared", true));
  RunOn();
  EXPECT_EQ(robot.seen, 5);
  MustSucceed(robot.supervisor.SetPaused("/laser", false));
  RunOn();
  EXPECT_EQ(robot.seen, 5);
}

TEST(SupervisedInRealTime, APortHasItsSafeValueWhileTheThreadOfWhatFeedsItIsStuck) {
  Robot robot(SchedulerOptions::ClockKind::kReal);
  std::atomic<bool> hangs{false};
  auto& other = robot.runtime.Create<Doing>(robot.runtime.root(), "other");
  other.action = [&](Doing&) { hangs.wait(true); };
  auto& apart = CreateThread(robot.runtime, "apart", {.period = 10ms});
  AssignThread(other, apart);
  AssignThread(robot.laser, apart);
  MustSucceed(robot.runtime.MakeReady(robot.runtime.root()));
  MustSucceed(robot.reader.in.SetDriving(true, {TypeOf<double>(), std::make_shared<double>(-7)}));
  MustSucceed(robot.scheduler.SetStuckLimit("", 50ms));
  MustSucceed(robot.scheduler.Start());
  WaitUntil("the laser is seen", [&] { return robot.seen == 1; });
  hangs = true;
  WaitUntil("the safe value is seen", [&] { return robot.seen == -7; });
  EXPECT_THAT(robot.Messages(),
              ::testing::Contains(HasSubstr("which runs /laser, does not return")));
  hangs = false;
  hangs.notify_all();
  WaitUntil("the laser is seen again", [&] { return robot.seen == 1; });
  robot.scheduler.Stop();
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
  AssignThread(listener, CreateThread(robot.runtime, "waiting",
                                      {.activation = ThreadOptions::Activation::kTrigger}));
  AssignThread(latched, OnlyOnData());
  MustSucceed(Port::Connect(robot.laser.out, listener.in));
  MustSucceed(robot.runtime.MakeReady(robot.runtime.root()));
  latched.out.Publish(3);
  MustSucceed(robot.supervisor.Add(
      {.input = listener.in.path(),
       .after = 30ms,
       .fresh_after = 50ms,
       .on_stale = {.changes = Switch(listener.in, robot.laser.out, latched.out)}}));
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
      for (const Notice& notice : another.supervisor.TakeNotices()) times.push_back(notice.time);
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
}  // namespace runnel

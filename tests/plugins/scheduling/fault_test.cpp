#include <gmock/gmock.h>

#include "core/module/group.h"
#include "plugins/scheduling/scheduler.h"
#include "tests/plugins/scheduling/test_modules.h"

namespace runnel {
namespace {

using testing::Base;

class FaultOf : public ::testing::Test {
 protected:
  FaultOf() {
    failing.action = [this](Doing& module) {
      ++failing_runs;
      if (module.cycle_time() >= At(20)) throw std::runtime_error("the sensor is on fire");
    };
    healthy.action = [this](Doing&) { ++healthy_runs; };
  }
  void Ready() { MustSucceed(runtime.MakeReady(runtime.root())); }

  Runtime runtime;
  Scheduler scheduler{runtime, {.clock = SchedulerOptions::ClockKind::kSimulated}};
  ThreadContainer& thread = CreateThread(runtime, "main", {.period = 10ms});
  Group& robot = runtime.Create<Group>(runtime.root(), "robot");
  Doing& failing = runtime.Create<Doing>(robot, "failing");
  Doing& healthy = runtime.Create<Doing>(robot, "healthy");
  int failing_runs = 0;
  int healthy_runs = 0;
};

TEST_F(FaultOf, AModuleStopsItAloneAndIsReported) {
  Ready();
  EXPECT_TRUE(scheduler.RunUntil(At(100)));
  EXPECT_EQ(failing_runs, 3);  // at 0, 10 and 20 ms
  EXPECT_EQ(healthy_runs, 10);
  const auto faults = scheduler.TakeFaults();
  ASSERT_THAT(faults, SizeIs(1));
  EXPECT_EQ(faults[0].path, "/robot/failing");
  EXPECT_EQ(faults[0].message, "the sensor is on fire");
  EXPECT_EQ(faults[0].time, At(20));
  EXPECT_THAT(scheduler.TakeFaults(), IsEmpty());
  EXPECT_FALSE(scheduler.stop_requested());
}

TEST_F(FaultOf, AnElementStopsAllItsTasks) {
  class Half final : public SenseControlModule {
   public:
    using SenseControlModule::SenseControlModule;
    int controls = 0;

   private:
    void Sense() override { throw 5; }
    void Control() override { ++controls; }
  };
  auto& half = runtime.Create<Half>(robot, "half");
  Ready();
  scheduler.RunUntil(At(20));
  EXPECT_EQ(half.controls, 0);
  const auto faults = scheduler.TakeFaults();
  ASSERT_THAT(faults, SizeIs(1));
  EXPECT_EQ(faults[0].message, "exception of type int");
}

TEST_F(FaultOf, AModuleStaysStoppedWhenTheStructureChanges) {
  Ready();
  scheduler.RunUntil(At(50));
  MustSucceed(Port::Connect(failing.out, healthy.in));
  scheduler.RunUntil(At(100));
  EXPECT_EQ(failing_runs, 3);
  EXPECT_THAT(scheduler.TakeFaults(), SizeIs(1));
}

TEST_F(FaultOf, ADeletedModuleIsStillReported) {
  Ready();
  scheduler.RunUntil(At(50));
  MustSucceed(runtime.Delete(failing));
  EXPECT_THAT(scheduler.TakeFaults(), SizeIs(1));
}

TEST_F(FaultOf, AModuleWithALongMessageIsCutOff) {
  failing.action = [](Doing&) { throw std::runtime_error(std::string(10000, 'x')); };
  Ready();
  scheduler.Step();
  EXPECT_EQ(scheduler.TakeFaults().at(0).message.size(), kLongestFaultMessage);
}

TEST_F(FaultOf, AModuleStopsTheApplicationByRule) {
  scheduler.AddFaultRule({.of = "/robot"});
  Ready();
  EXPECT_FALSE(scheduler.RunUntil(At(100)));
  EXPECT_TRUE(scheduler.stop_requested());
  EXPECT_EQ(runtime.clock().Now(), At(20));
  EXPECT_EQ(healthy_runs, 3);  // the cycle was brought to its end, and no other was begun
  EXPECT_FALSE(scheduler.Step());
  EXPECT_EQ(healthy_runs, 3);
}

TEST_F(FaultOf, AModuleOutsideOfTheRuleDoesNotStopTheApplication) {
  scheduler.AddFaultRule({.of = "/robot/fail"});  // no path part of "failing"
  scheduler.AddFaultRule({.of = "/robot/healthy"});
  Ready();
  EXPECT_TRUE(scheduler.RunUntil(At(100)));
}

TEST_F(FaultOf, AModuleCallsWhatTheRuleSays) {
  std::vector<std::string> called;
  scheduler.AddFaultRule({.of = "/robot/failing", .call = [&](const Fault& fault) {
                            EXPECT_EQ(CurrentCycle(), nullptr);  // not in the cycle that failed
                            called.push_back(fault.path);
                          }});
  Ready();
  scheduler.RunUntil(At(100));
  EXPECT_THAT(called, ElementsAre("/robot/failing"));
}

TEST_F(FaultOf, ARuleIsReportedToo) {
  scheduler.AddFaultRule({.of = "/robot", .call = [](const Fault&) { throw std::runtime_error("no"); }});
  Ready();
  scheduler.RunUntil(At(100));
  const auto faults = scheduler.TakeFaults();
  ASSERT_THAT(faults, SizeIs(2));
  EXPECT_THAT(faults[1].message, HasSubstr("the fault rule failed: no"));
}

TEST_F(FaultOf, ARuleThatThrowsAnythingIsReportedToo) {
  scheduler.AddFaultRule({.of = "/robot", .call = [](const Fault&) { throw 7; }});
  Ready();
  EXPECT_TRUE(scheduler.RunUntil(At(100)));
  const auto faults = scheduler.TakeFaults();
  ASSERT_THAT(faults, SizeIs(2));
  EXPECT_THAT(faults[1].message, HasSubstr("the fault rule failed: exception of type int"));
}

TEST_F(FaultOf, AFaultHandlerThatThrowsAnythingIsReportedAndTheFaultIsNotLost) {
  scheduler.SetFaultHandler([](const Fault&) -> FaultDispatcher::Action { throw 7; });
  Ready();
  EXPECT_TRUE(scheduler.RunUntil(At(100)));
  const auto faults = scheduler.TakeFaults();
  ASSERT_THAT(faults, SizeIs(2));
  EXPECT_EQ(faults[0].message, "the fault handler failed: exception of type int");
  EXPECT_EQ(faults[1].message, "the sensor is on fire");
}

TEST_F(FaultOf, WhatAFaultHandlerReturnsIsDoneAndToldAndIfItFailsTheRulesApply) {
  bool is_possible = true;
  int applied = 0;
  scheduler.SetFaultHandler([&](const Fault&) -> FaultDispatcher::Action {
    return [&] { return is_possible ? std::string("it is mended") : throw 7; };
  });
  scheduler.AddFaultRule({.of = "/robot/healthy", .call = [&](const Fault&) { ++applied; }});
  Ready();
  EXPECT_TRUE(scheduler.RunUntil(At(100)));
  const auto mended = scheduler.TakeFaults();
  ASSERT_THAT(mended, SizeIs(1));
  EXPECT_EQ(mended[0].message, "the sensor is on fire; it is mended");
  EXPECT_TRUE(mended[0].is_mended);
  is_possible = false;
  healthy.action = [](Doing&) { throw std::runtime_error("too"); };
  EXPECT_TRUE(scheduler.RunUntil(At(200)));
  const auto faults = scheduler.TakeFaults();
  ASSERT_THAT(faults, SizeIs(2));
  EXPECT_EQ(faults[0].message, "the fault handler failed: exception of type int");
  EXPECT_EQ(faults[1].message, "too");
  EXPECT_EQ(applied, 1);
}

TEST_F(FaultOf, AWatchThatThrowsAnythingIsReportedAndTriedAgain) {
  int looks = 0;
  scheduler.SetWatchdog([&](Time) -> Time {
    ++looks;
    throw 7;
  });
  Ready();
  EXPECT_TRUE(scheduler.RunUntil(At(1500)));
  EXPECT_EQ(looks, 30);  // each 50 ms
  EXPECT_EQ(scheduler.TakeFaults().at(0).message, "the watchdog failed: exception of type int");
}

}  // namespace
}  // namespace runnel

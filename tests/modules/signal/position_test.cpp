// Ramps before what moves to a position: an arm that waits where it is.

#include "modules/signal/filters.h"
#include "tests/plugins/supervision/supervised_robot.h"

namespace runnel::supervised {
namespace {

using signal::LowPassFilter;
using signal::RateLimiterFilter;
using ::testing::DoubleNear;

class Arm : public ::testing::Test {
 protected:
  Arm() {
    AddType<RateLimiterFilter>("signal/rate_limiter");
    AddType<LowPassFilter>("signal/low_pass");
    MustSucceed(robot.reader.in.SetDriving(true, {TypeOf<double>(), std::make_shared<double>(0.5)}));
    MustSucceed(Port::Disconnect(robot.laser.out, robot.reader.in));
    robot.laser.action = [this](Doing& module) {
      if (cycle_++ % every == 0) module.out.Publish(3);
    };
    Apply({CreateModule{"/ramp", "signal/rate_limiter"}, ConnectPorts{robot.laser.out.path(), "/ramp/in"},
           ConnectPorts{"/ramp/out", robot.reader.in.path()}});
  }
  template <typename Filter>
  void AddType(const char* name) {
    MustSucceed(robot.modules.Add({name, "", "test", [](const Placement& at) { return std::make_unique<Filter>(at); }}));
  }
  void Apply(const ChangeSet& changes) {
    const ChangeOutcome outcome = robot.editor.Apply(changes);
    ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
  }
  void Run(Duration time) { (void)robot.scheduler.RunUntil(robot.runtime.clock().Now() + time); }
  /// The least that has been seen in the time.
  double Least(Duration time) {
    double least = robot.seen;
    for (Duration each{}; each < time; each += 10ms) {
      Run(10ms);
      least = std::min<double>(least, robot.seen);
    }
    return least;
  }
  void SetByHand(double at, Port::Setter setter) {
    const std::lock_guard lock(robot.runtime.structure_mutex());
    MustSucceed(PublishByHand(robot.reader.in, &at, setter));
  }

  int every = 1;  // of how many cycles one has a setpoint
  Robot robot{SchedulerOptions::ClockKind::kSimulated};

 private:
  int cycle_ = 0;
};

TEST_F(Arm, WaitsWhereItIsWhenItsRampIsSwapped) {
  every = 100;
  Run(10s);
  ASSERT_EQ(robot.seen, 3);
  for (const char* type : {"signal/rate_limiter", "signal/low_pass"}) {
    Apply({ReplaceModule{"/ramp", type}});
    EXPECT_EQ(Least(3s), 3) << type;
  }
}

TEST_F(Arm, GoesFromItsSafePlaceAfterAStop) {
  Run(10s);
  robot.runtime.robot_stop().Press("a test");
  Run(1s);
  EXPECT_EQ(robot.seen, 0.5);
  ASSERT_TRUE(robot.runtime.robot_stop().Release("a test"));
  Run(500ms);
  EXPECT_THAT(robot.seen.load(), DoubleNear(1, 0.05)) << "1 per second";
}

TEST_F(Arm, GoesFromWhereItWasHeld) {
  Run(10s);
  SetByHand(2.9, Port::Setter::kPerson);
  Run(1s);
  ASSERT_EQ(robot.seen, 2.9);
  robot.reader.in.Release();
  EXPECT_GE(Least(300ms), 2.9);
}

TEST_F(Arm, GoesFromItsSafePlaceWhenWhatFeedsItRunsAgain) {
  Run(10s);
  MustSucceed(robot.supervisor.SetPaused("/laser", true));
  Run(1s);
  ASSERT_EQ(robot.seen, 0.5);
  MustSucceed(robot.supervisor.SetPaused("/laser", false));
  Run(500ms);
  EXPECT_THAT(robot.seen.load(), DoubleNear(1, 0.1));
}

TEST_F(Arm, WhatWasSaidOnceCountsAgainWhenARuleTakesItsValueBack) {
  every = 1 << 30;
  Run(1s);
  SetByHand(0.5, Port::Setter::kRule);
  Run(1s);
  robot.reader.in.Release(Port::Setter::kRule);
  Run(1s);
  EXPECT_EQ(robot.seen, 3);
}

TEST_F(Arm, ARampThatIsPutInAfterAStopBeginsWhereTheArmIs) {
  Apply({DeleteElement{"/ramp"}, ConnectPorts{robot.laser.out.path(), robot.reader.in.path()}});
  robot.runtime.robot_stop().Press("a test");
  Run(1s);
  ASSERT_TRUE(robot.runtime.robot_stop().Release("a test"));
  Run(1s);
  ASSERT_EQ(robot.seen, 3);
  Apply({DisconnectPorts{robot.laser.out.path(), robot.reader.in.path()}, CreateModule{"/ramp", "signal/rate_limiter"},
         ConnectPorts{robot.laser.out.path(), "/ramp/in"}, ConnectPorts{"/ramp/out", robot.reader.in.path()}});
  EXPECT_EQ(Least(1s), 3);
}

}  // namespace
}  // namespace runnel::supervised

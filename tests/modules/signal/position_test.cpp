// Ramps before what moves the robot: an arm that waits where it is, and motors.

#include "core/port/proxy_port.h"
#include "modules/signal/filters.h"
#include "modules/types/pose.h"
#include "tests/plugins/supervision/supervised_robot.h"

namespace runnel::supervised {
namespace {

using signal::LinearFilter;
using signal::LowPassFilter;
using signal::RateLimiterFilter;
using ::testing::DoubleNear;

class Arm : public ::testing::Test {
 protected:
  Arm() {
    AddType<RateLimiterFilter>("signal/rate_limiter");
    AddType<LowPassFilter>("signal/low_pass");
    MustSucceed(
        robot.reader.in.SetDriving(true, {TypeOf<double>(), std::make_shared<double>(0.5)}, {}, DrivingKind::kEffort));
    MustSucceed(Port::Disconnect(robot.laser.out, robot.reader.in));
    robot.laser.action = [this](Doing& module) {
      if (cycle_++ % every == 0) module.out.Publish(wish);
    };
    Apply({CreateModule{"/ramp", "signal/rate_limiter"}, ConnectPorts{robot.laser.out.path(), "/ramp/in"},
           ConnectPorts{"/ramp/out", robot.reader.in.path()}});
  }
  template <typename Filter>
  void AddType(const char* name) {
    MustSucceed(
        robot.modules.Add({name, "", "test", [](const Placement& at) { return std::make_unique<Filter>(at); }}));
  }
  void Apply(const ChangeSet& changes) {
    const ChangeOutcome outcome = robot.editor.Apply(changes);
    ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
  }
  template <typename M>
  M& At(const char* path) {
    return dynamic_cast<M&>(**robot.runtime.root().Find(path));
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
  double wish = 3;
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

TEST_F(Arm, GoesFromItsSafePlaceAlsoOverAnInterfacePort) {
  auto& border =
      robot.runtime.Create<ProxyPort>(robot.runtime.root(), "border", Port::Direction::kInput, TypeOf<double>());
  Apply({DisconnectPorts{"/ramp/out", robot.reader.in.path()}, ConnectPorts{"/ramp/out", border.path()},
         ConnectPorts{border.path(), robot.reader.in.path()}});
  Run(10s);
  robot.runtime.robot_stop().Press("a test");
  Run(1s);
  ASSERT_TRUE(robot.runtime.robot_stop().Release("a test"));
  Run(500ms);
  EXPECT_THAT(robot.seen.load(), DoubleNear(1, 0.05));
}

// What passes values on may scale them: its safe number is none of the ramp's.
TEST_F(Arm, GoesNoFurtherThanWishedWhenARampIsBeforeAGain) {
  AddType<LinearFilter>("signal/linear");
  Apply({DeleteElement{"/ramp"}, CreateModule{"/ramp", "signal/rate_limiter"}, CreateModule{"/servo", "signal/linear"},
         ConnectPorts{robot.laser.out.path(), "/ramp/in"}, ConnectPorts{"/ramp/out", "/servo/in"},
         ConnectPorts{"/servo/out", robot.reader.in.path()}});
  MustSucceed(At<LinearFilter>("/servo").gain.Set(100));
  Run(10s);
  ASSERT_EQ(robot.seen, 300);
  robot.runtime.robot_stop().Press("a test");
  Run(1s);
  ASSERT_TRUE(robot.runtime.robot_stop().Release("a test"));
  for (int i = 0; i < 100; ++i) {
    Run(10ms);
    ASSERT_LE(robot.seen, 300);
  }
}

// A gantry: what is done to one leaves the other where it is.
TEST_F(Arm, StaysWhereItIsWhenAnotherOneBehindItsRampIsFree) {
  Doing& other = robot.runtime.Create<Doing>(robot.runtime.root(), "other");
  MustSucceed(robot.runtime.MakeReady(robot.runtime.root()));
  MustSucceed(other.in.SetDriving(true, {TypeOf<double>(), std::make_shared<double>(0.5)}, {}, DrivingKind::kEffort));
  Apply({ConnectPorts{"/ramp/out", "/other/in"}});
  Run(10s);
  MustSucceed(other.in.Block());
  EXPECT_EQ(Least(1s), 3);
  EXPECT_TRUE(other.in.Unblock());
  EXPECT_EQ(Least(1s), 3);
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

TEST_F(Arm, GoesNoFasterAfterASilence) {
  Run(10s);
  every = 1 << 30;
  Run(10s);
  wish = 10;
  every = 1;
  Run(20ms);
  EXPECT_LE(robot.seen, 3.6) << "1 per second, of half a second";
}

// A structure says by its fields' units that it is a position.
TEST(PoseThatIsHeld, GoesOnFromThereWhenThatEnds) {
  struct Base final : Module {
    using Module::Module;
    Input<Pose2> in{this, "in"};
    Output<Pose2> out{this, "out"};
    double seen = 0;
    void Update() override { seen = in.Get().x; }
  };
  Robot robot{SchedulerOptions::ClockKind::kSimulated};
  auto& planner = robot.runtime.Create<Base>(robot.runtime.root(), "planner");
  auto& base = robot.runtime.Create<Base>(robot.runtime.root(), "base");
  MustSucceed(robot.runtime.MakeReady(robot.runtime.root()));
  MustSucceed(base.in.SetDriving(true, {TypeOf<Pose2>(), std::make_shared<Pose2>()}));
  MustSucceed(Port::Connect(planner.out, base.in));
  planner.out.Publish(Pose2{.x = 3});
  const Pose2 held{.x = 2.9};
  {
    const std::lock_guard lock(robot.runtime.structure_mutex());
    MustSucceed(PublishByHand(base.in, &held));
  }
  (void)robot.scheduler.RunUntil(robot.runtime.clock().Now() + 1s);
  ASSERT_EQ(base.seen, 2.9);
  base.in.Release();
  (void)robot.scheduler.RunUntil(robot.runtime.clock().Now() + 100ms);
  EXPECT_EQ(base.seen, 3) << "and not the pose that is zero";
}

struct Motor final : Module {
  Motor(const Placement& placement, const std::string& unit)
      : Module(placement),
        command(this, "command",
                {.unit = unit,
                 .drives = true,
                 .command = unit.empty() ? DrivingKind::kVelocity : DrivingKind::kUnspecified,
                 .safe_value = AnyValue(0.0)}) {}
  Input<double> command;
  double seen = 0;
  void Update() override { seen = command.Get(); }
};

class RampOfMotor : public ::testing::TestWithParam<const char*> {
 protected:
  RampOfMotor() {
    robot.laser.action = [this](Doing& module) {
      if (speaks) module.out.Publish(3);
    };
    MustSucceed(robot.runtime.MakeReady(robot.runtime.root()));
    MustSucceed(Port::Connect(robot.laser.out, ramp.in));
    MustSucceed(Port::Connect(ramp.out, gain.in));
    MustSucceed(Port::Connect(gain.out, motor.command));
  }
  void Run(Duration time) { (void)robot.scheduler.RunUntil(robot.runtime.clock().Now() + time); }
  void SetByHand(Port& port, Port::Setter setter) {
    const double zero = 0;
    const std::lock_guard lock(robot.runtime.structure_mutex());
    MustSucceed(PublishByHand(port, &zero, setter));
  }
  bool speaks = true;
  Robot robot{SchedulerOptions::ClockKind::kSimulated};
  RateLimiterFilter& ramp = robot.runtime.Create<RateLimiterFilter>(robot.runtime.root(), "ramp");
  LinearFilter& gain = robot.runtime.Create<LinearFilter>(robot.runtime.root(), "gain");
  Motor& motor = robot.runtime.Create<Motor>(robot.runtime.root(), "motor", GetParam());
};

TEST_P(RampOfMotor, BeginsFromAStandstillAfterASilence) {
  Run(5s);
  ASSERT_EQ(motor.seen, 3);
  speaks = false;
  Run(5s);
  speaks = true;
  Run(20ms);
  EXPECT_LT(motor.seen, 0.1);
}

// Also of a slow ramp, with a module behind it at which it is held.
TEST_P(RampOfMotor, WhatItHasMadeMeanwhileMovesNothing) {
  AssignThread(ramp, CreateThread(robot.runtime, "slow", {.period = 200ms}));
  for (const auto setter : {Port::Setter::kPerson, Port::Setter::kRule}) {
    for (Port* held : {static_cast<Port*>(&gain.in), static_cast<Port*>(&motor.command)}) {
      Run(8s);
      ASSERT_EQ(motor.seen, 3);
      SetByHand(*held, setter);
      Run(2010ms);
      ASSERT_EQ(motor.seen, 0);
      held->Release(setter);
      for (int i = 0; i < 24; ++i) {
        Run(10ms);
        ASSERT_LT(motor.seen, 0.5) << held->path();
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Units, RampOfMotor, ::testing::Values("m/s", "rpm", "deg/s", "N*m", "%", ""),
                         [](const auto& tried) { return "Unit" + std::to_string(tried.index); });

}  // namespace
}  // namespace runnel::supervised

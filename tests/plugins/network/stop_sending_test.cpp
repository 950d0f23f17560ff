// A stop goes over the network: what drives, or is a velocity, sends its safe value, and everything else goes on.
#include <algorithm>

#include <gmock/gmock.h>

#include "core/port/driving_ports.h"
#include "tests/plugins/network/network_member.h"

namespace runnel::test {
namespace {

using testing::Each;
using testing::HasSubstr;
using testing::Not;

struct Speed {
  double forward = 0;
};
inline void Describe(TypeBuilder<Speed>& type) {
  type.Name("test::Speed").Field("forward", &Speed::forward, {.unit = "m/s"});
}

class StopSendingTest : public testing::TestWithParam<ValueQuality> {
 protected:
  void Offer(const std::string& port, ValueQuality quality = GetParam()) {
    planner_.Offer({.port = "/application/" + port, .topic = "/" + port, .quality = quality});
  }
  void Begin() {
    planner_.Begin();
    robot_.Begin();
    all_ = std::make_unique<ProbePort>(robot_.runtime.root(), "all", TypeOf<Place>());
    const std::lock_guard lock(robot_.runtime.structure_mutex());
    ASSERT_TRUE(Port::Connect(*robot_.network->takes().front().output, *all_));
  }
  void BeginDriving() {
    Offer("module/place");
    robot_.Take({.topic = "/module/place"}, robot_.module.goal);
    Begin();
    ASSERT_TRUE(planner_.module.place.SetDriving(true, Place{-1, 0}));
    WaitUntil("it is read", [&] { return IsConnected(planner_.module.place); });
    Publish(1);
    WaitForGoal(1);
  }
  void Publish(double x) { planner_.module.place.Publish({x, 0}); }
  void WaitForGoal(double x) {
    WaitUntil("the robot reads " + std::to_string(x), [&] { return robot_.module.goal.Get().x == x; });
  }
  // All that has come since the last call.
  std::vector<double> Came() {
    std::vector<double> came;
    while (all_->Take([&](const void* value, ValueTimes) { came.push_back(static_cast<const Place*>(value)->x); })) {
    }
    return came;
  }

  const std::shared_ptr<WireEngine> engine_ = MakeFakeWire();
  Member planner_{*engine_, "planner"};
  Member robot_{*engine_, "robot"};
  RobotStop& stop_ = planner_.runtime.robot_stop();
  std::unique_ptr<ProbePort> all_;
};

TEST_P(StopSendingTest, WhatDrivesSendsItsSafeValueWhateverIsPublished) {
  BeginDriving();
  (void)Came();
  ASSERT_TRUE(stop_.Press("a test"));
  WaitForGoal(-1);
  for (int i = 0; i < 20; ++i) Publish(2 + i);
  (void)Came();
  WaitUntil("it is sent again for those who come", [&] { return !Came().empty(); });
  EXPECT_THAT(planner_.Text(), HasSubstr("STOPPED"));
  ASSERT_TRUE(stop_.Release("a test"));
  Publish(99);
  std::vector<double> came;
  WaitUntil("what is later than the release has come", [&] {
    std::ranges::copy(Came(), std::back_inserter(came));
    return std::ranges::count(came, 99) > 0;
  });
  EXPECT_THAT(came, Each(testing::AnyOf(-1, 99)));
  EXPECT_EQ(came.back(), 99);
  EXPECT_THAT(planner_.Text(), Not(HasSubstr("STOPPED")));
}

TEST_P(StopSendingTest, WhatWasPublishedBeforeTheReleaseIsNotSentAfterIt) {
  BeginDriving();
  ASSERT_TRUE(stop_.Press("a test"));
  Publish(2);
  ASSERT_TRUE(stop_.Release("a test"));
  WaitForGoal(-1);
  (void)Came();
  planner_.module.place.Publish({3, 0}, Time());  // measured before
  Publish(4);
  WaitForGoal(4);
  EXPECT_THAT(Came(), Each(testing::AnyOf(-1, 4)));
}

TEST_P(StopSendingTest, WhoComesLateIsStopped) {
  BeginDriving();
  ASSERT_TRUE(stop_.Press("a test"));
  Member other(*engine_, "other");
  other.Take({.topic = "/module/place"}, other.module.goal);
  other.Begin();
  WaitUntil("it is stopped", [&] { return other.module.goal.Get().x == -1; });
}

// As while a constructor runs that takes its time.
TEST_P(StopSendingTest, ItWaitsForNoLock) {
  BeginDriving();
  const std::lock_guard lock(planner_.runtime.structure_mutex());
  ASSERT_TRUE(stop_.Press("a test"));
  WaitForGoal(-1);
}

TEST_P(StopSendingTest, ABlockOfThePortAloneIsSent) {
  BeginDriving();
  ASSERT_TRUE(planner_.module.place.Block());
  WaitForGoal(-1);
  ASSERT_TRUE(planner_.module.place.Unblock());
  Publish(5);
  WaitForGoal(5);
}

TEST_P(StopSendingTest, VelocitiesStopUnmarkedAndMeasurementsGoOn) {
  Output<Speed> speed(planner_.group, "speed");
  Input<Speed> wanted(robot_.group, "wanted");
  Offer("module/place");
  Offer("speed");
  robot_.Take({.topic = "/module/place"}, robot_.module.goal);
  robot_.Take({.topic = "/speed"}, wanted);
  Begin();
  WaitUntil("both are read", [&] { return IsConnected(speed) && IsConnected(planner_.module.place); });
  speed.Publish({1});
  WaitUntil("it has come", [&] { return wanted.Get().forward == 1; });
  std::optional<std::string> drives;
  WaitUntil("what drives can be told", [&] { return (drives = FindWhatDrives(planner_.runtime)).has_value(); });
  EXPECT_EQ(drives, "/speed (in the network)");
  ASSERT_TRUE(stop_.Press("a test"));
  WaitUntil("it stands", [&] { return wanted.Get().forward == 0; });
  speed.Publish({2});
  Publish(7);
  WaitForGoal(7);
  EXPECT_EQ(wanted.Get().forward, 0);
  robot_.End();  // values are still on their way to ports that go now
  planner_.End();
}

TEST_P(StopSendingTest, ASpeedThatIsANumberStopsAndWhatIsMeasuredGoesOn) {
  Output<double> speed(planner_.group, "speed", {.unit = "m/s"});
  Output<Speed> measured(planner_.group, "measured");
  Input<double> wanted(robot_.group, "wanted", {.unit = "m/s"});
  Input<Speed> seen(robot_.group, "seen");
  Offer("speed");
  planner_.Offer({.port = "/application/measured", .topic = "/measured", .quality = GetParam(), .is_measured = true});
  robot_.Take({.topic = "/speed"}, wanted);
  robot_.Take({.topic = "/measured"}, seen);
  planner_.Begin();
  robot_.Begin();
  WaitUntil("both are read", [&] { return IsConnected(speed) && IsConnected(measured); });
  EXPECT_NE(speed.motion_beginnings(), 0u) << "a ramp before it begins from a standstill";
  WaitUntil("it has come", [&] {
    speed.Publish(1);
    return wanted.Get() == 1;
  });
  ASSERT_TRUE(stop_.Press("a test"));
  WaitUntil("it stands", [&] { return wanted.Get() == 0; });
  WaitUntil("what is measured has come", [&] {
    speed.Publish(2);
    measured.Publish({3});
    return seen.Get().forward == 3;
  });
  EXPECT_EQ(wanted.Get(), 0);
  robot_.End();  // values are still on their way to ports that go now
  planner_.End();
}

INSTANTIATE_TEST_SUITE_P(Qualities, StopSendingTest,
                         testing::Values(ValueQuality::kNewest, ValueQuality::kEach, ValueQuality::kSensor,
                                         ValueQuality::kLatched));

}  // namespace
}  // namespace runnel::test

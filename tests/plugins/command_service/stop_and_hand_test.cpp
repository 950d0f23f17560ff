// Values by hand beside STOP, rules, and those who look at them.

#include <atomic>
#include <thread>

#include "plugins/command_service/hand_settings.h"
#include "tests/core/port/stop_fixture.h"

namespace runnel::test {
namespace {

using namespace std::chrono_literals;

class StopAndHand : public StopTest {
 protected:
  ApplicationLog log{runtime.clock()};
  CommandWorker worker;
  ManualClock machine;
};

TEST_F(StopAndHand, AValueThatIsPublishedAtARateIsACommandFromBeforeTheRelease) {
  auto& sender = MakeSender<double>();
  auto& wheels = MakeReceiver<double>("wheels", Drives());
  Connect(sender.out, wheels.in);
  HandSettings by_hand(runtime, worker, log, &machine);
  ASSERT_TRUE(by_hand.Publish({"/wheels/in", "0.4", 1000.0}));
  Press();
  Release();
  // It would be published several times by now.
  for (int i = 0; i < 20; ++i) {
    clock.Advance(10ms);
    std::this_thread::sleep_for(2ms);
    EXPECT_EQ(wheels.in.Get(), 0.0);
  }
}

TEST_F(StopAndHand, AValueThatHasWaitedOverAStopIsRefused) {
  auto& wheels = MakeReceiver<double>("wheels", Drives());
  HandSettings by_hand(runtime, worker, log, &machine);
  const PublishRequest request{"/wheels/in", "0.4"};
  const RobotStop::AsOf before = runtime.robot_stop().AsOfNow();
  Press();
  Release();
  EXPECT_FALSE(by_hand.Publish(request, before));
  EXPECT_FALSE(wheels.in.is_set_by_hand());
  EXPECT_TRUE(by_hand.Publish(request));
}

TEST_F(StopAndHand, ReleasingWhatAPersonHasSetLeavesWhatARuleHasSet) {
  auto& sender = MakeSender<double>();
  auto& wheels = MakeReceiver<double>("wheels", Drives());
  Connect(sender.out, wheels.in);
  sender.out.Publish(0.9);
  HandSettings by_hand(runtime, worker, log, &machine);
  Set(wheels.in, 0.0, Port::Setter::kRule);
  ASSERT_TRUE(by_hand.Publish({"/wheels/in", "0.2"}));
  ASSERT_TRUE(ReleasePort(runtime, "/wheels/in"));
  EXPECT_EQ(wheels.in.Get(), 0.0);
  ASSERT_TRUE(ReleasePort(runtime, "/wheels/in")) << "a rule's value, too, if somebody wants that";
  EXPECT_EQ(wheels.in.Get(), 0.9);
}

// "Give back" of a link that was lost, carried out seconds later.
TEST_F(StopAndHand, AReleaseEndsNoBlockThatCameAfterItWasAskedFor) {
  auto& wheels = MakeReceiver<double>("wheels", Drives());
  HandSettings by_hand(runtime, worker, log, &machine);
  ASSERT_TRUE(by_hand.Publish({"/wheels/in", "0.4"}));
  const RobotStop::AsOf before = runtime.robot_stop().AsOfNow(SteadyClock().Now());
  ASSERT_TRUE(wheels.in.Block());
  const auto late = ReleasePort(runtime, "/wheels/in", before);
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error().message, "was blocked or set by hand after this was asked for; look why, then ask again");
  EXPECT_TRUE(wheels.in.is_blocked());
  EXPECT_TRUE(wheels.in.is_set_by_hand());
  ASSERT_TRUE(wheels.in.Block()) << "again, which counts";
  EXPECT_TRUE(ReleasePort(runtime, "/wheels/in", runtime.robot_stop().AsOfNow(SteadyClock().Now())));
  EXPECT_FALSE(wheels.in.is_blocked());
}

TEST_F(StopAndHand, ThePortOfBeforeEndsNoDeadlineOfTheOneInItsPlace) {
  auto& before = MakeReceiver<float>("before", {.unit = "m/s", .drives = true});
  auto& after = MakeReceiver<double>("after", Drives());
  HandSettings by_hand(runtime, worker, log, &machine);
  ASSERT_TRUE(by_hand.Publish({"/before/in", "0.2", {}, Duration(250ms), "a"}));
  after.in.InheritAnnotations(before.in);  // as where ports of one name are of two types
  ASSERT_TRUE(by_hand.Publish({"/after/in", "0.4", {}, Duration(250ms), "a"}));
  EXPECT_EQ(after.in.Get(), 0.4);
  ASSERT_TRUE(runtime.Delete(before));
  machine.Advance(1s);
  by_hand.LookAtDeadlines();
  EXPECT_EQ(after.in.Get(), 0.0);
}

// A deadlock would let the test run out of time.
TEST_F(StopAndHand, WhoLooksKeepsNoDeadlineUp) {
  constexpr int kPorts = 40;
  for (int i = 0; i < kPorts; ++i) MakeReceiver<double>("wheels" + std::to_string(i), Drives());
  HandSettings by_hand(runtime, worker, log);
  std::atomic<bool> ends{false};
  std::thread viewer([&] {
    while (!ends) (void)by_hand.All();
  });
  for (int round = 0; round < 20; ++round) {
    for (int i = 0; i < kPorts; ++i) {
      (void)by_hand.Publish({"/wheels" + std::to_string(i) + "/in", "0.3", {}, Duration(10ms), ""});
    }
    std::this_thread::sleep_for(12ms);
  }
  ends = true;
  viewer.join();
}

}  // namespace
}  // namespace runnel::test

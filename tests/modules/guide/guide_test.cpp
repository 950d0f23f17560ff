// The component that guides a robot: what it wishes in the situations that it knows.

#include <gmock/gmock.h>

#include "core/types/text_format.h"
#include "modules/types/pose.h"
#include "modules/types/surroundings.h"
#include "plugins/services/callable.h"
#include "plugins/testing/module_rig.h"

namespace runnel::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

class GuideTest : public testing::Test {
 protected:
  GuideTest() {
    around_.sensor_range = 2;
    around_.safe_distance = 0.3F;
    around_.is_measured = true;
    around_.contour.fill(65535);
    rig.Feed("surroundings", around_);
  }
  Callable& ServiceAt(const std::string& name) {
    return *dynamic_cast<Port&>(*rig.module.FindChild("output")->FindChild(name)).FindAnnotation<Callable>();
  }
  std::unique_ptr<AnyCall> Begin(const std::string& service, const std::string& arguments = "") {
    auto call = ServiceAt(service).NewCall();
    if (!arguments.empty()) {
      EXPECT_TRUE(SetFromText(*ServiceAt(service).arguments(), arguments, call->arguments()));
    }
    EXPECT_EQ(call->Begin(rig.now(), 100s), CallStatus::kPending);
    return call;
  }
  std::string Outcome(const std::string& service, AnyCall& call) {
    const CallStatus status = call.Poll(rig.now());
    if (status == CallStatus::kPending) return "pending";
    const TypeInfo* const reply = ServiceAt(service).reply();
    return status != CallStatus::kAnswered ? call.error() : reply != nullptr ? ToText(*reply, call.reply()) : "done";
  }
  std::string Call(const std::string& service, const std::string& arguments = "") {
    const auto call = Begin(service, arguments);
    rig.RunCycles(3);
    return Outcome(service, *call);
  }
  Twist2 WishAt(const Pose2& pose) {
    rig.Feed("pose", pose);
    rig.RunCycle();
    return rig.Last<Twist2>("twist");
  }
  /// A wall across the way, seen in the sectors ahead.
  void SeeAWallAhead() {
    for (std::size_t i = 0; i < 10; ++i) around_.contour[i] = around_.contour[119 - i] = 4 * 400;
    rig.Feed("surroundings", around_);
  }

  ModuleRig<FrameworkElement> rig{"guide/guide", 50ms};
  Surroundings around_{};
};

TEST_F(GuideTest, DrivesToItsGoalAndSaysHowLongTheWayWas) {
  const auto call = Begin("go_to", "{to: {x: 1, y: 0}}");
  rig.RunCycles(3);
  EXPECT_EQ(Outcome("go_to", *call), "pending") << "it waits for a pose";
  (void)WishAt({0, 0, 0});
  EXPECT_GT(WishAt({0, 0, 0}).forward, 0);
  EXPECT_GT(WishAt({0.5, -0.2, 0}).turn, 0) << "to the left, where the goal is";
  const Twist2 there = WishAt({0.95, 0, 0});
  EXPECT_EQ(there.forward, 0);
  EXPECT_EQ(there.turn, 0);
  rig.RunCycle();
  EXPECT_THAT(Outcome("go_to", *call), testing::StartsWith("1.0")) << "m, by way of (0.5, -0.2)";
}

TEST_F(GuideTest, FollowsAWallThatIsInItsWay) {
  const auto call = Begin("go_to");  // 4, 2: as the description says
  (void)WishAt({0, 0, 0.4636});
  (void)WishAt({0, 0, 0.4636});
  EXPECT_STREQ(call->doing(), "drive");
  SeeAWallAhead();
  const Twist2 aside = WishAt({0.5, 0.25, 0.4636});
  EXPECT_STREQ(call->doing(), "follow");
  EXPECT_LT(aside.turn, 0) << "the wall is to be on the left";
  EXPECT_THAT(Call("get_trip"), HasSubstr("to: {x: 4, y: 2}"));
}

TEST_F(GuideTest, IsHaltedAndGoesOn) {
  const auto call = Begin("go_to", "{to: {x: 3, y: 0}}");
  for (int i = 0; i < 4; ++i) (void)WishAt({0, 0, 0});
  EXPECT_EQ(Call("halt"), "done");
  EXPECT_EQ(rig.Last<Twist2>("twist").forward, 0);
  EXPECT_EQ(Outcome("go_to", *call), "0") << "its codel of stop comes to ether";
  const auto resumed = Begin("resume");
  rig.RunCycles(3);
  EXPECT_GT(rig.Last<Twist2>("twist").forward, 0);
  EXPECT_EQ(Outcome("resume", *resumed), "pending");
}

TEST_F(GuideTest, RefusesWhatCannotBe) {
  EXPECT_EQ(Call("go_to", "{to: {x: 101}}"), "guide::too_far {limit: 100}");
  EXPECT_EQ(Call("set_limits", "{limits: {speed: 2, turn_rate: 1}}"), "guide::too_far {limit: 1}");
  EXPECT_EQ(Call("resume"), "guide::no_pose");
}

}  // namespace
}  // namespace runnel::test

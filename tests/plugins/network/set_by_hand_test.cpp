// What is set by hand at an offered output, and what is converted before it, is what others get: the values that readers here find.
#include "core/port/proxy_port.h"
#include "tests/plugins/network/network_member.h"

namespace runnel::test {
namespace {

Port::Fill FillPlace(double x) {
  return [x](void* value) -> Result<void> {
    *static_cast<Place*>(value) = {x, 0};
    return {};
  };
}

class SetByHandTest : public testing::TestWithParam<ValueQuality> {
 protected:
  void Begin() {
    planner_.Offer({.port = "/application/module/place", .topic = "/drive", .quality = GetParam()});
    robot_.Take({.topic = "/drive"}, robot_.module.goal);
    planner_.Begin();
    robot_.Begin();
    WaitUntil("it is read", [&] { return IsConnected(planner_.module.place); });
  }
  void WaitForGoal(double x) {
    WaitUntil("the robot reads " + std::to_string(x), [&] { return robot_.module.goal.Get().x == x; });
  }

  const std::shared_ptr<WireEngine> engine_ = MakeFakeWire();
  Member planner_{*engine_, "planner"};
  Member robot_{*engine_, "robot"};
};

TEST_P(SetByHandTest, OthersGetItUntilItIsReleased) {
  Begin();
  Output<Place>& place = planner_.module.place;
  place.Publish({1, 0});
  WaitForGoal(1);
  ASSERT_TRUE(place.PublishByHand(FillPlace(9)));  // as many values as the module has published
  WaitForGoal(9);
  ASSERT_TRUE(place.PublishByHand(FillPlace(10)));
  WaitForGoal(10);
  place.Publish({2, 0});
  ASSERT_TRUE(place.PublishByHand(FillPlace(11)));
  WaitForGoal(11);
  ASSERT_TRUE(place.Release());
  WaitForGoal(2);
  place.Publish({3, 0});
  WaitForGoal(3);
}

TEST_P(SetByHandTest, WhoComesLateGetsWhatIsSetByHand) {
  planner_.Offer({.port = "/application/module/place", .topic = "/drive", .quality = GetParam()});
  planner_.Begin();
  planner_.module.place.Publish({1, 0});
  ASSERT_TRUE(planner_.module.place.PublishByHand(FillPlace(9)));
  robot_.Take({.topic = "/drive"}, robot_.module.goal);
  robot_.Begin();
  WaitForGoal(9);
}

INSTANTIATE_TEST_SUITE_P(Qualities, SetByHandTest,
                         testing::Values(ValueQuality::kNewest, ValueQuality::kEach, ValueQuality::kLatched));

TEST(OfferedInterfacePortTest, OthersGetWhatTheConversionBeforeItMakes) {
  const std::shared_ptr<WireEngine> engine = MakeFakeWire();
  Member planner(*engine, "planner");
  Member robot(*engine, "robot");
  auto& border = planner.runtime.Create<ProxyPort>(planner.group, "border", Port::Direction::kOutput, TypeOf<double>());
  ASSERT_TRUE(Port::Connect(planner.module.place, border, {.part = "y"}));
  Input<double> y(robot.group, "y");
  planner.Offer({.port = "/application/border", .topic = "/y"});
  robot.Take({.topic = "/y"}, y);
  planner.Begin();
  robot.Begin();
  WaitUntil("it is read", [&] { return IsConnected(border); });
  planner.module.place.Publish({1, 2});
  WaitUntil("a value has come", [&] { return y.Peek().has_value(); });
  EXPECT_EQ(y.Get(), 2);
}

}  // namespace
}  // namespace runnel::test

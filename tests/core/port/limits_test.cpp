#include <cmath>
#include <limits>

#include "tests/core/port/port_fixture.h"

namespace runnel::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class LimitsTest : public PortTest {
 protected:
  Input<double>& MakeLimited(InputLimits limits, const std::string& name = "receiver") {
    auto& receiver = MakeReceiver<double>(name, {.limits = std::move(limits)});
    EXPECT_TRUE(runtime.MakeReady(receiver));
    return receiver.in;
  }
};

TEST_F(LimitsTest, TheDefaultIsReadWhileThereIsNothingElse) {
  auto& in = MakeLimited({.default_value = 0.5});
  EXPECT_EQ(in.Get(), 0.5);
  auto& sender = MakeSender<double>();
  Connect(sender.out, in);
  EXPECT_EQ(in.Get(), 0.5) << "nothing has come yet";
  sender.out.Publish(2.0);
  EXPECT_EQ(in.Get(), 2.0);
  EXPECT_THAT(in.Sources(), ElementsAre(&sender.out));
  ASSERT_TRUE(runtime.Delete(sender));
  EXPECT_EQ(in.Get(), 0.5) << "its source went";
}

TEST_F(LimitsTest, WhatIsOutOfBoundsIsWhatThePortSays) {
  auto& sender = MakeSender<double>();
  auto& discards = MakeLimited({.minimum = 0, .maximum = 1}, "discards");
  auto& clamps = MakeLimited({.minimum = 0, .maximum = 1, .out_of_bounds = OutOfBounds::kClamp}, "clamps");
  auto& replaces = MakeLimited(
      {.default_value = 0.25, .minimum = 0, .maximum = 1, .out_of_bounds = OutOfBounds::kDefault}, "replaces");
  auto& free = MakeReceiver<double>("free").in;
  for (Port* each : {static_cast<Port*>(&discards), static_cast<Port*>(&clamps), static_cast<Port*>(&replaces),
                     static_cast<Port*>(&free)}) {
    Connect(sender.out, *each, {.queue = 8});
  }
  for (const double value : {0.5, 3.0, -1.0, std::nan("")}) sender.out.Publish(value);
  EXPECT_THAT(TakeAll(discards), ElementsAre(0.5));
  EXPECT_THAT(TakeAll(clamps), ElementsAre(0.5, 1.0, 0.0));
  EXPECT_THAT(TakeAll(replaces), ElementsAre(0.25, 0.5, 0.25, 0.25, 0.25));
  EXPECT_EQ(TakeAll(free).size(), 4u);
  EXPECT_EQ(discards.out_of_bounds(), 3u);
  EXPECT_EQ(clamps.out_of_bounds(), 3u);
  EXPECT_EQ(free.out_of_bounds(), 0u);
}

TEST_F(LimitsTest, AfterAConversionItIsLookedAtToo) {
  auto& sender = MakeSender<int>();
  auto& in = MakeLimited({.minimum = 0, .maximum = 10, .out_of_bounds = OutOfBounds::kClamp});
  Connect(sender.out, in);
  sender.out.Publish(20);
  EXPECT_EQ(in.Get(), 10);
  ASSERT_TRUE(Port::Disconnect(sender.out, in));
  sender.out.Publish(5);
  EXPECT_FALSE(in.Read());
}

TEST_F(LimitsTest, EachInputKeepsItsOwnWhenItTakesOver) {
  auto& sender = MakeSender<double>();
  auto& before = MakeLimited({.minimum = 0, .maximum = 1}, "before");
  auto& after = MakeLimited({.minimum = 0, .maximum = 5, .out_of_bounds = OutOfBounds::kClamp}, "after");
  Connect(sender.out, before, {.queue = 4});
  sender.out.Publish(0.5);
  after.TakeOver(before);
  sender.out.Publish(9.0);
  EXPECT_EQ(after.Get(), 5.0);
  EXPECT_EQ(before.limits().maximum, 1.0);
  EXPECT_EQ(after.limits().maximum, 5.0);
  EXPECT_THAT(TakeAll(after), testing::Contains(5.0));
}

TEST_F(LimitsTest, AHandIsHeldToThemAndToldSo) {
  auto& in = MakeLimited({.minimum = 0, .maximum = 1});
  const auto refused = in.PublishByHand([](void* value) -> Result<void> {
    *static_cast<double*>(value) = 2;
    return {};
  });
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("0 .. 1"));
  EXPECT_FALSE(in.is_set_by_hand());
}

TEST_F(LimitsTest, ThoseThatMakeNoSenseAreRefused) {
  auto& in = MakeReceiver<double>().in;
  EXPECT_FALSE(in.SetLimits({.default_value = 1}));
  EXPECT_FALSE(in.SetLimits({.default_value = 3.0, .maximum = 2}));
  EXPECT_FALSE(in.SetLimits({.minimum = 3, .maximum = 2}));
  EXPECT_FALSE(in.SetLimits({.minimum = 3, .out_of_bounds = OutOfBounds::kDefault}));
  EXPECT_FALSE(MakeReceiver<Scan>("scan").in.SetLimits({.minimum = 3}));
  EXPECT_FALSE(MakeSender<double>().out.SetLimits({.minimum = 3}));
  EXPECT_TRUE(in.SetLimits({.minimum = 3}));
  EXPECT_EQ(BoundsText(in.limits()), "3 ..");
  EXPECT_TRUE(in.SetLimits({}));
  EXPECT_EQ(BoundsText(in.limits()), "");
}

}  // namespace
}  // namespace runnel::test

#include "tests/core/port/stop_fixture.h"

namespace runnel::test {
namespace {

using testing::HasSubstr;

TEST_F(StopTest, AMarkedOutputStopsAllWhoReadFromItAlsoBehindAConversionOrAValueByHand) {
  auto& sender = MakeSender<Speeds>();
  auto& group = runtime.Create<ProxyPort>(runtime.root(), "passes", Port::Direction::kOutput, TypeOf<Speeds>());
  auto& whole = MakeReceiver<Speeds>("whole");
  auto& part = MakeReceiver<double>("part");
  Connect(sender.out, group);
  Connect(group, whole.in);
  Connect(group, part.in, {.part = "turn"});
  ASSERT_TRUE(sender.out.SetDriving(true, Speeds{.forward = 0, .turn = 0.5}));
  EXPECT_TRUE(sender.out.is_driving());
  sender.out.Publish({1, 2});
  EXPECT_EQ(part.in.Get(), 2.0);
  Press();
  EXPECT_EQ(whole.in.Get().forward, 0.0);
  EXPECT_EQ(part.in.Get(), 0.5) << "the part of the safe value";
  Set(part.in, 7.0);
  EXPECT_EQ(part.in.Get(), 0.5) << "a value by hand behind it is no way around";
  Release();
  ASSERT_TRUE(sender.out.SetDriving(false));
  Set(part.in, 7.0);
  EXPECT_EQ(part.in.Get(), 7.0);
}

TEST_F(StopTest, PortsThatComeLaterAreStopped) {
  Press();
  auto& sender = MakeSender<double>();
  auto& wheels = MakeReceiver<double>("wheels", Drives());
  Connect(sender.out, wheels.in);
  sender.out.Publish(4.0);
  EXPECT_EQ(wheels.in.Get(), 0.0);
  auto& marked = MakeReceiver<double>("marked");
  Connect(sender.out, marked.in);
  ASSERT_TRUE(marked.in.SetDriving(true, 0.25, {}, DrivingKind::kVelocity));
  EXPECT_EQ(marked.in.Get(), 0.25);
}

// An application has its ports connected before it knows by which clock it runs.
TEST_F(StopTest, ASafeValueIsStampedByTheClockThatTheApplicationRunsBy) {
  auto& sender = MakeSender<double>();
  auto& wheels = MakeReceiver<double>("wheels", Drives());
  Connect(sender.out, wheels.in);
  ManualClock later;
  later.Advance(std::chrono::seconds(5000));
  runtime.set_clock(later);
  Press();
  EXPECT_EQ(wheels.in.Read().timestamp(), later.Now());
  runtime.set_clock(clock);
}

// Nothing moves by a command from before; and whoever looks for what is new finds each time that it ends.
TEST_F(StopTest, WhenAPersonsValueEndsOnlyWhatIsPublishedAfterwardsCounts) {
  auto& sender = MakeSender<double>();
  auto& wheels = MakeReceiver<double>("wheels", Drives());
  Connect(sender.out, wheels.in);
  sender.out.Publish(4.0);
  for (int i = 0; i < 3; ++i) {
    clock.Advance(std::chrono::seconds(1));
    Set(wheels.in, 1.0);
    EXPECT_EQ(wheels.in.Get(), 1.0);
    clock.Advance(std::chrono::seconds(1));
    ASSERT_TRUE(wheels.in.Release());
    const auto read = wheels.in.Read();
    EXPECT_TRUE(read.is_new()) << i;
    EXPECT_EQ(*read, 0.0);
  }
  sender.out.Publish(4.0);
  EXPECT_EQ(wheels.in.Get(), 4.0) << "also of the very moment of its end";
}

TEST_F(StopTest, ABlockStopsOnePortAlone) {
  auto& sender = MakeSender<double>("sender", {.unit = "m/s"});
  auto& blocked = MakeReceiver<double>("blocked", {.unit = "m/s"});
  auto& other = MakeReceiver<double>("other", Drives());
  Connect(sender.out, blocked.in);
  Connect(sender.out, other.in);
  sender.out.Publish(2.0);
  ASSERT_TRUE(blocked.in.Block());
  EXPECT_TRUE(blocked.in.is_blocked());
  EXPECT_FALSE(blocked.in.is_driving());
  EXPECT_EQ(blocked.in.Get(), 0.0);
  EXPECT_EQ(other.in.Get(), 2.0);
  ASSERT_TRUE(blocked.in.SetDriving(true)) << "it stays blocked";
  EXPECT_TRUE(blocked.in.is_blocked());
  clock.Advance(std::chrono::milliseconds(1));
  EXPECT_TRUE(blocked.in.Unblock());
  EXPECT_FALSE(blocked.in.Unblock());
  EXPECT_EQ(blocked.in.Get(), 0.0);
  clock.Advance(std::chrono::milliseconds(1));
  sender.out.Publish(3.0);
  EXPECT_EQ(blocked.in.Get(), 3.0);
}

TEST_F(StopTest, GoesOverToAPortThatTakesThePlace) {
  auto& sender = MakeSender<double>();
  auto& before = MakeReceiver<double>("before", Drives());
  Connect(sender.out, before.in);
  ASSERT_TRUE(before.in.Block());
  auto& after = MakeReceiver<double>("after");
  after.in.TakeOver(before.in);
  EXPECT_TRUE(after.in.is_driving());
  EXPECT_TRUE(after.in.is_blocked());
  sender.out.Publish(3.0);
  EXPECT_EQ(after.in.Get(), 0.0);
  before.in.TakeOver(after.in);
  EXPECT_TRUE(before.in.is_blocked());
  EXPECT_EQ(before.in.Get(), 0.0);
}

TEST_F(StopTest, APortDrivesAsItsModuleSaysAlsoInThePlaceOfOneThatDidNotOrWasBlocked) {
  for (const bool was_blocked : {false, true}) {
    SCOPED_TRACE(was_blocked);
    const std::string name = was_blocked ? "blocked" : "free";
    auto& sender = MakeSender<double>(name + "_sender");
    auto& before = MakeReceiver<double>(name + "_before", {.unit = "m/s"});
    Connect(sender.out, before.in);
    if (was_blocked) {
      ASSERT_TRUE(before.in.Block());
      Press();
      Release();
      ASSERT_TRUE(before.in.Unblock());
    }
    auto& after = MakeReceiver<double>(name + "_after", Drives());
    after.in.TakeOver(before.in);
    EXPECT_TRUE(after.in.is_driving());
    Press();
    sender.out.Publish(3.0);
    EXPECT_EQ(after.in.Get(), 0.0);
    EXPECT_FALSE(after.in.SetDriving(false));
    Release();
  }
}

TEST_F(StopTest, APortWithoutASafeValueDoesNotDrive) {
  auto& position = MakeReceiver<double>("position", {.unit = "m"});
  const auto set = position.in.SetDriving(true);
  ASSERT_FALSE(set);
  EXPECT_THAT(set.error().message, HasSubstr("no safe value"));
  EXPECT_FALSE(position.in.is_driving());
  EXPECT_FALSE(position.in.Block());
  EXPECT_TRUE(position.in.SetDriving(true, 1.5));
  EXPECT_THROW(MakeReceiver<double>("arm", {.unit = "m", .drives = true}), ElementError);
  EXPECT_THROW(MakeReceiver<double>("arm", {.unit = "m", .drives = true, .safe_value = 1}), ElementError);
  EXPECT_TRUE(
      MakeReceiver<double>("arm", {.unit = "m", .limits = {.default_value = 2.0}, .drives = true}).in.is_driving());
}

TEST_F(StopTest, TheSafeValueOfAVelocityIsZeroWhateverIsReadWhileNothingComes) {
  auto& speed = MakeReceiver<double>("speed", {.unit = "m/s", .limits = {.default_value = 0.2}, .drives = true});
  auto& slow = MakeReceiver<double>(
      "slow", {.unit = "m/s", .limits = {.default_value = 0.2}, .drives = true, .safe_value = 0.1});
  auto& marked = MakeReceiver<double>("marked", {.unit = "m/s", .limits = {.default_value = 0.2}});
  ASSERT_TRUE(runtime.MakeReady(runtime.root()));
  ASSERT_TRUE(marked.in.SetDriving(true));
  EXPECT_EQ(speed.in.Get(), 0.2);
  Press();
  EXPECT_EQ(speed.in.Get(), 0.0);
  EXPECT_EQ(slow.in.Get(), 0.1) << "its module says so";
  EXPECT_EQ(marked.in.Get(), 0.0);
}

TEST_F(StopTest, TheSafeValueIsTheOneOfTheModuleThatIsThereNow) {
  auto& sender = MakeSender<double>();
  auto& before = MakeReceiver<double>("before", {.unit = "m", .drives = true, .safe_value = 1.0});
  Connect(sender.out, before.in);
  auto& after = MakeReceiver<double>("after", {.unit = "m", .drives = true, .safe_value = 2.0});
  after.in.TakeOver(before.in);
  Press();
  EXPECT_EQ(after.in.Get(), 2.0);
  before.in.TakeOver(after.in);
  EXPECT_EQ(before.in.Get(), 1.0);
}

TEST_F(StopTest, APortThatIsNotConnectedHasItsSafeValue) {
  auto& sender = MakeSender<double>();
  auto& arm = MakeReceiver<double>("arm", {.unit = "m", .drives = true, .safe_value = 0.5});
  EXPECT_FALSE(arm.in.Read());
  Connect(sender.out, arm.in);
  sender.out.Publish(0.7);
  Press();
  EXPECT_EQ(arm.in.Get(), 0.5);
  ASSERT_TRUE(Port::Disconnect(sender.out, arm.in));
  EXPECT_EQ(arm.in.Get(), 0.5);
  EXPECT_TRUE(arm.in.is_stopped());
}

// Behind a conversion the safe value is made anew with each binding.
TEST_F(StopTest, AShortPressIsNotMissedBehindAConversionThatIsBoundAnew) {
  auto& sender = MakeSender<Speeds>();
  auto& queued = MakeReceiver<double>("queued");
  ASSERT_TRUE(sender.out.SetDriving(true));
  Connect(sender.out, queued.in, {.queue = 4, .part = "turn"});
  sender.out.Publish({1, 2});
  EXPECT_EQ(queued.in.Take().value_or(-1), 2.0);
  Press();
  Release();
  Connect(MakeSender<double>("other").out, queued.in);
  EXPECT_EQ(queued.in.Take().value_or(-1), 0.0);
}

}  // namespace
}  // namespace runnel::test

// Ports that say how they brake: what readers find between a press and the safe value.

#include <cmath>
#include <limits>

#include "core/port/cycle.h"
#include "plugins/testing/guards.h"
#include "tests/core/port/stop_fixture.h"

namespace runnel::test {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;

struct ManySpeeds {
  Speeds front, middle, rear;
};
[[maybe_unused]] void Describe(TypeBuilder<ManySpeeds>& type) {
  type.Name("test::ManySpeeds")
      .Field("front", &ManySpeeds::front)
      .Field("middle", &ManySpeeds::middle)
      .Field("rear", &ManySpeeds::rear);
}

class BrakingTest : public StopTest {
 protected:
  static InputOptions Brakes(int time = 100) { return {.unit = "m/s", .drives = true, .brake = milliseconds(time)}; }
  void Pass(int time) { clock.Advance(milliseconds(time)); }
};

TEST_F(BrakingTest, GoesFromTheValueReadLastToTheSafeOneNumberByNumber) {
  auto& sender = MakeSender<Speeds>();
  auto& wheels = MakeReceiver<Speeds>("wheels", {.drives = true, .brake = milliseconds(100)});
  Connect(sender.out, wheels.in);
  sender.out.Publish({1, -2});
  EXPECT_EQ(wheels.in.Get().forward, 1.0);
  sender.out.Publish({5, 5});  // which nobody has read
  Press();
  EXPECT_EQ(wheels.in.Get().forward, 1.0);
  Pass(25);
  sender.out.Publish({9, 9});
  EXPECT_DOUBLE_EQ(wheels.in.Get().forward, 0.75);
  EXPECT_DOUBLE_EQ(wheels.in.Get().turn, -1.5);
  EXPECT_FALSE(wheels.in.is_stopped()) << "it is not at a standstill yet";
  Pass(50);
  EXPECT_DOUBLE_EQ(wheels.in.Peek()->forward, 0.25);
  Pass(25);
  EXPECT_EQ(wheels.in.Get().forward, 0.0);
  EXPECT_TRUE(wheels.in.is_stopped());
  Pass(1000);
  EXPECT_EQ(wheels.in.Get().turn, 0.0);
}

TEST_F(BrakingTest, EachValueOnTheWayIsNewAndTheSafeOneToo) {
  auto& sender = MakeSender<double>();
  auto& wheels = MakeReceiver<double>("wheels", Brakes());
  Connect(sender.out, wheels.in);
  sender.out.Publish(1.0);
  (void)wheels.in.Read();
  Press();
  std::vector<double> read;
  std::uint64_t before = wheels.in.publications();
  for (int i = 0; i < 6; ++i) {
    Pass(20);
    const auto next = wheels.in.Read();
    if (!next.is_new()) continue;
    EXPECT_GT(wheels.in.publications(), before) << "who looks on looks again";
    EXPECT_EQ(next.missed(), 0u);
    before = wheels.in.publications();
    read.push_back(std::round(100 * *next));
  }
  EXPECT_THAT(read, ElementsAre(80, 60, 40, 20, 0));
}

TEST_F(BrakingTest, WithinACycleThereIsOneValueOnTheWay) {
  auto& sender = MakeSender<double>();
  auto& wheels = MakeReceiver<double>("wheels", Brakes());
  Connect(sender.out, wheels.in);
  sender.out.Publish(1.0);
  EXPECT_EQ(wheels.in.Get(), 1.0);
  Press();
  Pass(20);
  const CycleScope cycle({.now = clock.Now()});
  EXPECT_TRUE(wheels.in.Read().is_new());
  Pass(20);  // as on a clock that goes on meanwhile
  const auto again = wheels.in.Read();
  EXPECT_FALSE(again.is_new());
  EXPECT_DOUBLE_EQ(again.value_or(0), 0.8);
}

TEST_F(BrakingTest, WhatWasOldStaysOld) {
  auto& sender = MakeSender<double>();
  auto& wheels = MakeReceiver<double>("wheels", Brakes());
  Connect(sender.out, wheels.in);
  sender.out.Publish(1.0);
  Pass(60'000);
  EXPECT_EQ(wheels.in.Get(), 1.0);
  Press();
  Pass(25);
  EXPECT_EQ(clock.Now() - wheels.in.Read().timestamp(), milliseconds(60'000)) << "a command of that age drives nobody";
}

TEST_F(BrakingTest, WhoDoesNotReadAnyMoreIsNotSetInMotion) {
  auto& sender = MakeSender<double>();
  auto& wheels = MakeReceiver<double>("wheels", Brakes());
  Connect(sender.out, wheels.in);
  sender.out.Publish(1.0);
  EXPECT_EQ(wheels.in.Get(), 1.0);
  Pass(501);
  Press();
  EXPECT_EQ(wheels.in.Get(), 0.0);
  Pass(25);
  EXPECT_EQ(wheels.in.Get(), 0.0);
}

TEST_F(BrakingTest, TypesThatAreReadWhereTheyLieAreRefused) {
  auto& wheels = MakeReceiver<ManySpeeds>("wheels", {});
  const auto set = wheels.in.SetDriving(true, ManySpeeds{}, milliseconds(100));
  ASSERT_FALSE(set);
  EXPECT_THAT(set.error().message, HasSubstr("cannot brake"));
}

TEST_F(BrakingTest, ASecondStopDoesNotBeginAnew) {
  auto& sender = MakeSender<double>();
  auto& wheels = MakeReceiver<double>("wheels", Brakes());
  Connect(sender.out, wheels.in);
  sender.out.Publish(1.0);
  EXPECT_EQ(wheels.in.Get(), 1.0);
  Press();
  Pass(40);
  ASSERT_TRUE(wheels.in.Block());
  EXPECT_DOUBLE_EQ(wheels.in.Get(), 0.6);
  Pass(18);
  Release();  // it is blocked still, 2 ms later
  EXPECT_DOUBLE_EQ(wheels.in.Get(), 0.4);
  ASSERT_TRUE(wheels.in.Unblock());
  EXPECT_EQ(wheels.in.Get(), 0.0) << "nothing moves by a command from before a release";
  Press();
  EXPECT_EQ(wheels.in.Get(), 0.0) << "nothing has been read between the two";
  Release();
  sender.out.Publish(0.5);
  EXPECT_EQ(wheels.in.Get(), 0.5);
  Pass(1);
  Press();
  Pass(50);
  EXPECT_DOUBLE_EQ(wheels.in.Get(), 0.25) << "a STOP after a release brakes, and from what was read last";
}

TEST_F(BrakingTest, NothingThatWasNeverReadIsBrakedFrom) {
  auto& sender = MakeSender<double>();
  auto& wheels = MakeReceiver<double>("wheels", Brakes());
  Connect(sender.out, wheels.in);
  sender.out.Publish(1.0);
  Press();
  EXPECT_EQ(wheels.in.Get(), 0.0);
  EXPECT_TRUE(wheels.in.is_stopped());
  Release();
  sender.out.Publish(std::numeric_limits<double>::quiet_NaN());
  (void)wheels.in.Get();
  Pass(1);
  Press();
  EXPECT_EQ(wheels.in.Get(), 0.0) << "nor what is no number";
}

TEST_F(BrakingTest, WhoIsWokenByValuesOrHasAQueueFindsTheSafeValueAtOnce) {
  auto& sender = MakeSender<double>();
  auto& queued = MakeReceiver<double>("queued", Brakes());
  auto& woken = MakeReceiver<double>("woken", Brakes());
  CountingWaker waker;
  woken.in.SetWaker(&waker);
  Connect(sender.out, queued.in, {.queue = 4});
  Connect(sender.out, woken.in);
  sender.out.Publish(1.0);
  EXPECT_THAT(TakeAll(queued.in), ElementsAre(1.0));
  EXPECT_EQ(woken.in.Read().value_or(-1), 1.0);
  Press();
  EXPECT_THAT(TakeAll(queued.in), ElementsAre(0.0));
  EXPECT_EQ(woken.in.Get(), 0.0);
  woken.in.SetWaker(nullptr);
  EXPECT_EQ(woken.in.Get(), 0.0) << "it does not begin to move again";
}

TEST_F(BrakingTest, BehindAMarkedOutputEachReaderBrakesByItsOwnType) {
  auto& sender = MakeSender<Speeds>();
  auto& part = MakeReceiver<double>("part");
  auto& text = MakeReceiver<std::string>("text");
  ASSERT_TRUE(sender.out.SetDriving(true, Speeds{.turn = 1}, milliseconds(100)));
  Connect(sender.out, part.in, {.part = "turn"});
  Connect(sender.out, text.in, {.part = "turn"});
  sender.out.Publish({1, 3});
  EXPECT_EQ(part.in.Get(), 3.0);
  EXPECT_EQ(text.in.Read().value_or(""), "3");
  Press();
  Pass(50);
  EXPECT_DOUBLE_EQ(part.in.Get(), 2.0);
  EXPECT_EQ(text.in.Read().value_or(""), "1") << "a text has no values between two others";
}

TEST_F(BrakingTest, IsRefusedWhereNothingIsBetweenTwoValues) {
  auto& name = MakeReceiver<std::string>("name");
  const auto set = name.in.SetDriving(true, std::string("stand"), milliseconds(100));
  ASSERT_FALSE(set);
  EXPECT_THAT(set.error().ToString(), testing::AllOf(HasSubstr("name"), HasSubstr("cannot brake: a string"),
                                                     HasSubstr("leave out how long it brakes")));
  EXPECT_FALSE(name.in.is_driving());
  EXPECT_TRUE(name.in.SetDriving(true, std::string("stand")));
  EXPECT_THROW(MakeReceiver<Speeds>("far", {.drives = true, .brake = std::chrono::seconds(3000)}), ElementError)
      << "3000 ms were meant";
  EXPECT_THROW(MakeReceiver<bool>("lamp", {.drives = true, .safe_value = false, .brake = milliseconds(1)}),
               ElementError);
}

TEST_F(BrakingTest, IsThatOfTheModuleUnlessSomebodySaysOtherwise) {
  auto& wheels = MakeReceiver<double>("wheels", Brakes());
  ASSERT_TRUE(wheels.in.SetDriving(true));
  EXPECT_EQ(wheels.in.stop()->brake(), milliseconds(100));
  ASSERT_TRUE(wheels.in.SetDriving(true, {}, milliseconds(200)));
  auto& after = MakeReceiver<double>("after");
  after.in.TakeOver(wheels.in);
  EXPECT_EQ(after.in.stop()->brake(), milliseconds(200));
}

TEST_F(BrakingTest, ReadingMeanwhileNeitherAllocatesNorLocks) {
  auto& sender = MakeSender<Speeds>();
  auto& wheels = MakeReceiver<Speeds>("wheels", {.drives = true, .brake = milliseconds(100)});
  Connect(sender.out, wheels.in);
  sender.out.Publish({1, 1});
  (void)wheels.in.Read();
  Press();
  const OwnCycle cycle(clock.Now());
  (void)wheels.in.Read();
  Pass(50);
  const CycleScope next({.now = clock.Now()});
  const AllocationGuard allocations;
  const LockProbe locks;
  const auto read = wheels.in.Read();
  EXPECT_DOUBLE_EQ(read->forward, 0.5);
  EXPECT_EQ(allocations.allocations(), 0u);
  EXPECT_EQ(locks.locks(), 0u);
}

}  // namespace
}  // namespace runnel::test

#include "core/conversion/conversion.h"
#include "tests/core/port/port_fixture.h"

namespace runnel::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class ByHandTest : public PortTest {
 protected:
  static void Set(Port& port, double number) {
    const auto set = port.PublishByHand([&](void* value) -> Result<void> {
      *static_cast<double*>(value) = number;
      return {};
    });
    ASSERT_TRUE(set) << set.error().ToString();
  }
};

TEST_F(ByHandTest, AnInputReadsItUntilItIsReleased) {
  auto& sender = MakeSender<double>();
  auto& set = MakeReceiver<double>("set");
  auto& other = MakeReceiver<double>("other");
  Connect(sender.out, set.in);
  Connect(sender.out, other.in);
  sender.out.Publish(1.0);
  EXPECT_FALSE(set.in.is_set_by_hand());
  Set(set.in, 7.0);
  EXPECT_TRUE(set.in.is_set_by_hand());
  EXPECT_EQ(set.in.Read().value_or(0), 7.0);
  sender.out.Publish(2.0);
  EXPECT_EQ(set.in.Get(), 7.0) << "what its module's source publishes is not read";
  EXPECT_EQ(other.in.Get(), 2.0) << "others read on";
  Set(set.in, 8.0);
  const auto second = set.in.Read();
  EXPECT_TRUE(second.is_new());
  EXPECT_EQ(*second, 8.0);
  EXPECT_TRUE(set.in.Release());
  EXPECT_EQ(set.in.Get(), 2.0);
  EXPECT_FALSE(set.in.Release()) << "once";
}

TEST_F(ByHandTest, AllWhoReadFromAnOutputFindIt) {
  auto& sender = MakeSender<double>();
  auto& latest = MakeReceiver<double>("latest");
  auto& queued = MakeReceiver<double>("queued");
  Connect(sender.out, latest.in);
  Connect(sender.out, queued.in, {.queue = 4});
  sender.out.Publish(1.0);
  Set(sender.out, 5.0);
  sender.out.Publish(2.0);
  Set(sender.out, 6.0);
  EXPECT_EQ(latest.in.Get(), 6.0);
  EXPECT_THAT(TakeAll(queued.in), ElementsAre(1.0, 5.0, 6.0));
  // Who comes later finds it, too; the structure is as before.
  auto& late = MakeReceiver<double>("late");
  Connect(sender.out, late.in);
  EXPECT_EQ(late.in.Get(), 6.0);
  EXPECT_THAT(latest.in.Sources(), ElementsAre(&sender.out));
  EXPECT_TRUE(sender.out.Release());
  sender.out.Publish(3.0);
  EXPECT_EQ(latest.in.Get(), 3.0);
  EXPECT_EQ(late.in.Get(), 3.0);
  EXPECT_THAT(TakeAll(queued.in), testing::Contains(3.0));
}

TEST_F(ByHandTest, AnInterfacePortPassesItOn) {
  auto& sender = MakeSender<double>();
  auto& proxy = runtime.Create<ProxyPort>(runtime.root(), "interface", Port::Direction::kInput, TypeOf<double>());
  auto& receiver = MakeReceiver<double>();
  Connect(sender.out, proxy);
  Connect(proxy, receiver.in);
  sender.out.Publish(1.0);
  Set(proxy, 4.0);
  sender.out.Publish(2.0);
  EXPECT_EQ(receiver.in.Get(), 4.0);
  double shown = 0;
  EXPECT_TRUE(proxy.VisitLatest([&](const void* value, ValueTimes) { shown = *static_cast<const double*>(value); }));
  EXPECT_EQ(shown, 4.0);
  EXPECT_TRUE(proxy.Release());
  EXPECT_EQ(receiver.in.Get(), 2.0);
}

TEST_F(ByHandTest, AnUnconnectedInputWakesItsReader) {
  auto& receiver = MakeReceiver<double>();
  CountingWaker waker;
  receiver.in.SetWaker(&waker);
  Set(receiver.in, 1.0);
  EXPECT_EQ(waker.wakes, 1);
  Set(receiver.in, 2.0);
  EXPECT_EQ(waker.wakes, 2);
  receiver.in.SetWaker(nullptr);
}

TEST_F(ByHandTest, ItGoesOverToWhoTakesOver) {
  auto& sender = MakeSender<double>();
  auto& before = MakeReceiver<double>("before");
  auto& after = MakeReceiver<double>("after");
  Connect(sender.out, before.in);
  Set(before.in, 7.0);
  after.in.TakeOver(before.in);
  EXPECT_TRUE(after.in.is_set_by_hand());
  EXPECT_FALSE(before.in.is_set_by_hand());
  EXPECT_EQ(after.in.Get(), 7.0);
  Set(after.in, 8.0);
  EXPECT_EQ(after.in.Get(), 8.0);
  sender.out.Publish(1.0);
  EXPECT_TRUE(after.in.Release());
  EXPECT_EQ(after.in.Get(), 1.0);
  auto& next = MakeSender<double>("next");
  Set(sender.out, 9.0);
  next.out.TakeOver(sender.out);
  EXPECT_TRUE(next.out.is_set_by_hand());
  EXPECT_EQ(after.in.Get(), 9.0);
  EXPECT_TRUE(next.out.Release());
  next.out.Publish(2.0);
  EXPECT_EQ(after.in.Get(), 2.0);
}

TEST_F(ByHandTest, WhatCannotBeFilledChangesNothing) {
  auto& sender = MakeSender<double>();
  auto& receiver = MakeReceiver<double>();
  Connect(sender.out, receiver.in);
  sender.out.Publish(1.0);
  EXPECT_FALSE(receiver.in.PublishByHand([](void*) -> Result<void> { return Error{.message = "no"}; }));
  EXPECT_FALSE(receiver.in.is_set_by_hand());
  EXPECT_EQ(receiver.in.Get(), 1.0);
  auto& sealed = runtime.Create<Receiver<Sealed>>(runtime.root(), "sealed");
  EXPECT_FALSE(sealed.in.PublishByHand([](void*) -> Result<void> { return {}; }));
}

TEST_F(ByHandTest, APortThatIsDeletedTakesItAlong) {
  auto& sender = MakeSender<double>();
  auto& receiver = MakeReceiver<double>();
  Connect(sender.out, receiver.in);
  Set(sender.out, 3.0);
  EXPECT_EQ(receiver.in.Get(), 3.0);
  ASSERT_TRUE(runtime.Delete(sender));
  EXPECT_FALSE(receiver.in.Read());
  Set(receiver.in, 4.0);
  ASSERT_TRUE(runtime.Delete(receiver));
}

}  // namespace
}  // namespace runnel::test

#include "tests/core/port/port_fixture.h"

namespace runnel::test {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using SeveralSourcesTest = PortTest;

TEST_F(SeveralSourcesTest, ValuePublishedLastCountsForAllInputsAlike) {
  auto& a = MakeSender<int>("a");
  auto& b = MakeSender<int>("b");
  auto& first = MakeReceiver<int>("first");
  auto& second = MakeReceiver<int>("second");
  Connect(a.out, first.in);
  Connect(b.out, first.in);
  Connect(b.out, second.in);  // the other way round
  Connect(a.out, second.in);
  for (int i = 0; i < 10; ++i) {
    auto& sender = i % 3 == 0 ? a : b;
    sender.out.Publish(i);
    EXPECT_EQ(*first.in.Read(), i);
    EXPECT_EQ(*second.in.Read(), i);
    EXPECT_EQ(second.in.Get(), i);
  }
}

TEST_F(SeveralSourcesTest, WorksForTypesInBuffersToo) {
  auto& a = MakeSender<Scan>("a");
  auto& b = MakeSender<Scan>("b");
  auto& receiver = MakeReceiver<Scan>();
  Connect(a.out, receiver.in);
  Connect(b.out, receiver.in);
  b.out.Publish(Scan{{}, 1});
  a.out.Publish(Scan{{}, 2});
  EXPECT_EQ(receiver.in.Read()->number, 2);
  b.out.Publish(Scan{{}, 3});
  EXPECT_EQ(receiver.in.Read()->number, 3);
}

TEST_F(SeveralSourcesTest, ChangeOfSourceIsNewAndCountsNothingAsMissed) {
  auto& a = MakeSender<int>("a");
  auto& b = MakeSender<int>("b");
  auto& receiver = MakeReceiver<int>();
  Connect(a.out, receiver.in);
  Connect(b.out, receiver.in);
  for (int i = 0; i < 5; ++i) a.out.Publish(i);
  (void)receiver.in.Read();
  b.out.Publish(7);
  const auto lease = receiver.in.Read();
  EXPECT_TRUE(lease.is_new());
  EXPECT_EQ(lease.missed(), 0u);
}

TEST_F(SeveralSourcesTest, ValueThatWasReadIsOldWhenTheLaterSourceGoes) {
  auto& a = MakeSender<int>("a");
  auto& b = MakeSender<int>("b");
  auto& receiver = MakeReceiver<int>();
  Connect(a.out, receiver.in);
  Connect(b.out, receiver.in);
  a.out.Publish(1);
  EXPECT_TRUE(receiver.in.Read().is_new());
  b.out.Publish(2);
  EXPECT_TRUE(receiver.in.Read().is_new());
  ASSERT_TRUE(runtime.Delete(b));
  EXPECT_EQ(*receiver.in.Peek(), 1);
  EXPECT_EQ(receiver.in.Peek().freshness(), Freshness::kOld);
  EXPECT_EQ(receiver.in.Read().freshness(), Freshness::kOld);
}

TEST_F(SeveralSourcesTest, OfValuesFromBeforeTheSharingTheLaterInTimeCounts) {
  auto& early = MakeSender<int>("early");
  auto& late = MakeSender<int>("late");
  auto& receiver = MakeReceiver<int>();
  clock.Set(Time(1s));
  late.out.Publish(1);
  clock.Set(Time(2s));
  early.out.Publish(2);
  Connect(early.out, receiver.in);
  Connect(late.out, receiver.in);
  EXPECT_EQ(*receiver.in.Read(), 2);
}

TEST_F(SeveralSourcesTest, NumberedValueThatIsOlderDoesNotHideAYoungerOneWithoutNumber) {
  auto& shared = MakeSender<int>("shared");
  auto& other = MakeSender<int>("other");
  auto& alone = MakeSender<int>("alone");
  auto& sharing = MakeReceiver<int>("sharing");
  auto& receiver = MakeReceiver<int>("receiver");
  Connect(shared.out, sharing.in);
  Connect(other.out, sharing.in);
  clock.Set(Time(1s));
  shared.out.Publish(1);  // has a number, since it shares an input
  clock.Set(Time(2s));
  alone.out.Publish(2);
  Connect(shared.out, receiver.in);
  Connect(alone.out, receiver.in);
  EXPECT_EQ(*receiver.in.Read(), 2);
}

TEST_F(SeveralSourcesTest, SourceThatComesBackDoesNotBringAnOldValueBack) {
  auto& a = MakeSender<int>("a");
  auto& b = MakeSender<int>("b");
  auto& receiver = MakeReceiver<int>();
  Connect(a.out, receiver.in);
  Connect(b.out, receiver.in);
  clock.Set(Time(1s));
  b.out.Publish(1);
  ASSERT_TRUE(Port::Disconnect(b.out, receiver.in));
  clock.Set(Time(2s));
  a.out.Publish(2);
  Connect(b.out, receiver.in);
  EXPECT_EQ(*receiver.in.Read(), 2);
}

TEST_F(SeveralSourcesTest, ValuesOfAllSourcesWaitInTheOrderOfTheirComing) {
  auto& a = MakeSender<int>("a");
  auto& b = MakeSender<int>("b");
  auto& receiver = MakeReceiver<int>();
  Connect(a.out, receiver.in, {.queue = 8});
  Connect(b.out, receiver.in, {.queue = 8});
  a.out.Publish(1);
  b.out.Publish(2);
  b.out.Publish(3);
  a.out.Publish(4);
  EXPECT_THAT(TakeAll(receiver.in), ElementsAre(1, 2, 3, 4));
}

TEST_F(SeveralSourcesTest, WhatWaitsOfADisconnectedSourceIsStillTaken) {
  auto& a = MakeSender<int>("a");
  auto& b = MakeSender<int>("b");
  auto& receiver = MakeReceiver<int>();
  Connect(a.out, receiver.in, {.queue = 8});
  Connect(b.out, receiver.in, {.queue = 8});
  a.out.Publish(1);
  b.out.Publish(2);
  ASSERT_TRUE(runtime.Delete(a));
  EXPECT_THAT(TakeAll(receiver.in), ElementsAre(1, 2));
}

TEST_F(SeveralSourcesTest, OneOutputFeedsManyInputs) {
  auto& sender = MakeSender<Scan>();
  std::vector<Receiver<Scan>*> receivers;
  for (int i = 0; i < 10; ++i) {
    receivers.push_back(&MakeReceiver<Scan>("receiver" + std::to_string(i)));
    Connect(sender.out, receivers.back()->in, {.queue = i % 2 == 0 ? 2u : 0u});
  }
  sender.out.Publish(Scan{{}, 5});
  const Scan* const only = &*receivers.front()->in.Read();
  for (auto* each : receivers) EXPECT_EQ(&*each->in.Read(), only);
  EXPECT_EQ(sender.out.Sinks().size(), 10u);
}

}  // namespace
}  // namespace runnel::test
